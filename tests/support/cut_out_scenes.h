#pragma once

#include <facemap/model.h>

#include "support/random.h"
#include "support/scenes.h"

namespace test_scenes {

/// Gives the faces of a mesh textures that cut holes, and others that do not: small images, each use of them with its
/// own wraps, transform and cutoff, the cutoff often the value of a texel. Many crossings lie on borders of texels.
facemap::Model with_holes(const TestScene& test, Random& random);

}  // namespace test_scenes
