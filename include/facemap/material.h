#pragma once

#include <facemap/vector.h>

#include <map>
#include <string>

namespace facemap {

/// A material of an MTL file, read and kept; shading does not use it yet.
struct Material {
  std::string name;                             ///< newmtl
  Vector ambient{0};                            ///< Ka
  Vector diffuse{0.8f};                         ///< Kd
  Vector specular{0};                           ///< Ks
  Vector emission{0};                           ///< Ke
  float shininess = 0;                          ///< Ns
  float optical_density = 1;                    ///< Ni
  float opacity = 1;                            ///< d, or 1 - Tr
  int illumination = 2;                         ///< illum
  std::map<std::string, std::string> textures;  ///< map_Kd and the like: statement -> file name as written
};

}  // namespace facemap
