#pragma once

#include <facemap/color.h>
#include <facemap/light.h>
#include <facemap/mesh.h>
#include <facemap/renderer.h>
#include <facemap/scene_file.h>

#include <vector>

namespace facemap {

/// How a photographer would show a model: from the front, a little from the left and above, filling the picture; on a
/// floor; with a key light, a fill light and a rim light; with a sky, so that nothing is black.
struct Studio {
  View view;
  std::vector<Light> lights;  ///< key, fill, rim
  SceneGround ground;
  Color background;
  Color sky_up, sky_down;
};

/// A studio for the triangles of `mesh` and pictures of so many pixels. The front is where +z is if `up` is (0, 1, 0),
/// -y if it is (0, 0, 1). Throws Error if `up` has no direction or the mesh no triangle.
Studio make_studio(const Mesh& mesh, const Vector& up, int width, int height);

}  // namespace facemap
