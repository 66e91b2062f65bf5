#pragma once

#include <facemap/scene.h>
#include <facemap/vector.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace facemap::bench {

/// 0 to 1, less than 1; takes the seed a step on.
double random_fraction(std::uint64_t& seed);

/// Random points on a scene's faces, uniform by area, rounded to float32, in random order. `lift`: world units that
/// they are moved along their faces' normals; `faces`: gets the face of each, or null.
std::vector<Vector> surface_points(const Scene& scene, std::size_t count, std::uint64_t seed, double lift = 0,
                                   std::vector<FaceId>* faces = nullptr);

}  // namespace facemap::bench
