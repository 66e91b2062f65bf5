#pragma once

#include <facemap/generators.h>

#include <string>

#include "scene/generators/solids.h"

namespace facemap::generators {

/// Collects solids into a GeneratedScene; positions are rounded to float32 here and nowhere else.
class SceneBuilder {
 public:
  /// Names all that is placed from here to the next call.
  void start_part(const std::string& name);

  void place(const Solid& solid, const Placement& placement = {});

  void set_camera(const Vector& position, const Vector& look_at, float field_angle_deg);
  void add_light(const Vector& position, const Vector& color, float intensity);

  GeneratedScene take() { return std::move(scene_); }

 private:
  GeneratedScene scene_;
};

GeneratedScene make_chessboard(int detail);
GeneratedScene make_grass(int detail);
GeneratedScene make_bust(int detail);
GeneratedScene make_typewriter(int detail);

}  // namespace facemap::generators
