#include "visibility_surface.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace facemap::bench {

// splitmix64.
double random_fraction(std::uint64_t& seed) {
  std::uint64_t x = seed += 0x9e3779b97f4a7c15u;
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
  x = (x ^ x >> 27) * 0x94d049bb133111ebu;
  return static_cast<double>((x ^ x >> 31) >> 11) * 0x1p-53;
}

std::vector<Vector> surface_points(const Scene& scene, std::size_t count, std::uint64_t seed, double lift,
                                   std::vector<FaceId>* faces) {
  const Mesh& mesh = scene.mesh();
  const auto corner = [&](std::size_t face, int k) { return DVector(mesh.vertex(face, k)); };
  const auto normal_of = [&](std::size_t face) {
    return glm::cross(corner(face, 1) - corner(face, 0), corner(face, 2) - corner(face, 0));
  };
  std::vector<double> sums;  // of areas, twice
  double sum = 0;
  for (std::size_t face = 0; face < mesh.face_count(); ++face) sums.push_back(sum += glm::length(normal_of(face)));

  std::vector<Vector> points(count);
  for (Vector& point : points) {
    const auto at = std::upper_bound(sums.begin(), sums.end(), random_fraction(seed) * sum);
    const auto face = std::min(static_cast<std::size_t>(at - sums.begin()), sums.size() - 1);
    const double root = std::sqrt(random_fraction(seed)), along = random_fraction(seed);
    DVector p = (1 - root) * corner(face, 0) + root * (1 - along) * corner(face, 1) + root * along * corner(face, 2);
    if (lift != 0) p += lift * glm::normalize(normal_of(face));
    point = Vector(p);
    if (faces != nullptr) faces->push_back(static_cast<FaceId>(face));
  }
  return points;
}

}  // namespace facemap::bench
