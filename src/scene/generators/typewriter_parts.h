#pragma once

#include "scene/generators/scene_builder.h"
#include "scene/generators/solids.h"

namespace facemap::generators {

/// The typewriter's assemblies, each placed where it belongs: +x to the right of the typist, y = 0 the table, +z
/// towards the typist. One unit is about 4 cm.
void add_frame(SceneBuilder& scene, int detail);
void add_keyboard(SceneBuilder& scene, int detail);
void add_type_basket(SceneBuilder& scene, int detail);
void add_ribbon(SceneBuilder& scene, int detail);
void add_carriage(SceneBuilder& scene, int detail);

/// An outline drawn in a side view, as (z, y), stretched along x about `x`.
Placement side_view(double x);

/// An outline drawn in a plan view, as (x, -z), stretched along y about `y`.
Placement plan_view(double y);

/// A turned part whose axis runs along +x from `origin`.
Placement along_x(const DVector& origin);

}  // namespace facemap::generators
