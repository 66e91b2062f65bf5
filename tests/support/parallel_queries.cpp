#include "support/parallel_queries.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace test_queries {

using facemap::DVector;
using facemap::FaceId;
using facemap::Mesh;
using facemap::Vector;
using oracle::Oracle;
using test_scenes::TestScene;

namespace {

bool is_finite(const Vector& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

Vector make_direction(const Oracle& oracle, Random& random) {
  const Mesh& mesh = oracle.mesh();
  const auto face = [&] {
    return oracle.kept_faces()[static_cast<std::size_t>(random.below(static_cast<int>(oracle.kept_faces().size())))];
  };
  const FaceId f = face(), g = face();
  const Vector a = mesh.vertex(f, 0), b = mesh.vertex(f, 1), c = mesh.vertex(f, 2), e = mesh.vertex(g, 0);
  Vector d(random.direction());
  switch (random.below(6)) {
    case 0:
      d = b - a;
      break;
    case 1:
      d = e - a;
      break;
    case 2:
      d = (b - a) + static_cast<float>(random.unit()) * (c - a);
      break;
    case 3:
      d = Vector(0);
      d[random.below(3)] = random.chance(0.5) ? 1.0f : -1.0f;
      break;
    default:
      break;
  }
  const bool is_usable = std::isfinite(d.x) && std::isfinite(d.y) && std::isfinite(d.z) && d != Vector(0);
  return is_usable ? d : Vector(random.direction());
}

Vector make_point(const TestScene& scene, const Oracle& oracle, Random& random) {
  const auto count = static_cast<int>(oracle.kept_faces().size());
  const FaceId f = oracle.kept_faces()[static_cast<std::size_t>(random.below(count))];
  const DVector a(scene.mesh.vertex(f, 0)), b(scene.mesh.vertex(f, 1)), c(scene.mesh.vertex(f, 2));
  const int choice = random.below(5);
  if (choice == 0) return Vector(a);
  const double p = random.unit(), q = choice == 1 ? 0.5 : random.unit(), r = choice == 2 ? 0 : (1 - p) * q;
  Vector P(a + p * (b - a) + r * (c - a));
  if (choice == 3) P = Vector(DVector(scene.centre) + scene.radius * random.in_cube());
  return is_finite(P) ? P : Vector(a);
}

Vector make_ray_origin(const TestScene& scene, const Oracle& oracle, const Vector& d, Random& random) {
  const Vector P = make_point(scene, oracle, random);
  if (random.chance(0.2)) return P;
  const double step = (random.chance(0.5) ? 4.0 : random.unit()) * scene.radius / glm::length(DVector(d));
  const Vector O(DVector(P) - (random.chance(0.5) ? std::exp2(std::round(std::log2(step))) : step) * DVector(d));
  return is_finite(O) ? O : P;
}

}  // namespace test_queries
