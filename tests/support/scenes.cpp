#include "support/scenes.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <utility>
#include <vector>

namespace test_scenes {
namespace {

using facemap::Corners;
using facemap::DVector;

Vector rounded(const DVector& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

Vector lattice_point(Random& random, int reach) {
  const int x = random.between(-reach, reach), y = random.between(-reach, reach), z = random.between(-reach, reach);
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

std::uint32_t add_vertex(Mesh& mesh, const Vector& v) {
  mesh.positions.push_back(v);
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

Mesh soup(int face_count, Random& random) {
  Mesh mesh;
  for (int i = 0; i < face_count; ++i) {
    const DVector at = random.in_cube();
    const double size = std::pow(2.0, random.between(-6.0, 0.5));
    const DVector a = random.in_cube(), b = random.in_cube(), c = random.in_cube();
    add_triangle(mesh, rounded(at + size * a), rounded(at + size * b), rounded(at + size * c));
  }
  return mesh;
}

Mesh patch(int face_count, Random& random) {
  const int side = std::max(1, static_cast<int>(std::sqrt(face_count / 2.0)));
  const double roughness = random.chance(0.3) ? 0 : random.between(0.0, 0.5);
  Mesh mesh;
  for (int i = 0; i <= side; ++i) {
    for (int j = 0; j <= side; ++j) {
      const double x = 2.0 * i / side - 1, y = 2.0 * j / side - 1;
      add_vertex(mesh, rounded(DVector(x, roughness * random.between(-1.0, 1.0), y)));
    }
  }
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const std::uint32_t p = i * (side + 1) + j, q = p + 1, r = p + side + 1, s = r + 1;
      mesh.triangles.push_back({p, q, r});
      mesh.triangles.push_back({q, s, r});
    }
  }
  return mesh;
}

Mesh slivers(int face_count, Random& random) {
  Mesh mesh;
  DVector a = random.in_cube(), b = random.in_cube();
  for (int i = 0; i < face_count; ++i) {
    if (random.chance(0.4)) a = random.in_cube();
    if (random.chance(0.4)) b = random.in_cube();
    const double width = std::pow(2.0, random.between(-20.0, -6.0));
    const double along = random.between(-0.2, 1.2);
    const DVector c = a + along * (b - a) + width * random.in_cube();
    add_triangle(mesh, rounded(a), rounded(b), rounded(c));
  }
  return mesh;
}

Mesh lattice(int face_count, Random& random) {
  const int reach = random.between(2, 8);
  Mesh mesh;
  for (int i = 0; i < face_count; ++i) {
    const Vector a = lattice_point(random, reach), b = lattice_point(random, reach), c = lattice_point(random, reach);
    add_triangle(mesh, a, b, c);
  }
  return mesh;
}

Mesh coplanar(int face_count, Random& random) {
  Mesh mesh;
  Vector origin(0), u(1, 0, 0), v(0, 1, 0);
  for (int i = 0; i < face_count; ++i) {
    if (i % 12 == 0) {
      origin = lattice_point(random, 4);
      u = lattice_point(random, 2);
      v = lattice_point(random, 2);
    }
    const auto point = [&] {
      const auto p = static_cast<float>(random.between(-3, 3)), q = static_cast<float>(random.between(-3, 3));
      return origin + p * u + q * v;
    };
    const Vector a = point(), b = point(), c = point();
    add_triangle(mesh, a, b, c);
    if (random.chance(0.1)) add_triangle(mesh, b, a, c);                             // a duplicate turned around
    if (random.chance(0.1)) add_triangle(mesh, a, b, c + lattice_point(random, 1));  // a fold
  }
  return mesh;
}

Mesh boxes(int face_count, Random& random) {
  Mesh mesh;
  for (int i = 0; i < std::max(1, face_count / 12); ++i) {
    const Vector lower = lattice_point(random, 4);
    const Vector size = glm::abs(lattice_point(random, 2)) + Vector(1);
    mesh = joined(mesh, box(lower, lower + size));
  }
  return mesh;
}

Mesh ball(int face_count, Random& random) {
  const int stacks = std::max(2, static_cast<int>(std::sqrt(face_count / 4.0)));
  return uv_sphere(std::max(3, 2 * stacks), stacks, DVector(0), random.between(0.2, 1.0));
}

// A polyhedron about the centre with corners pushed to random distances.
Mesh shell(Random& random) {
  const int slices = random.between(3, 7), stacks = random.between(2, 4);
  Mesh mesh = uv_sphere(slices, stacks, DVector(0), 1);
  const bool is_rough = random.chance(0.7);
  for (Vector& v : mesh.positions) {
    if (is_rough) v *= static_cast<float>(std::pow(2.0, random.between(-3.0, 1.0)));
  }
  return mesh;
}

Mesh fan(int face_count, Random& random) {
  Mesh mesh;
  const bool is_flat = random.chance(0.4);
  const Vector apex = rounded(0.2 * random.in_cube());
  const auto rim = [&](int i) {
    const double angle = 2 * M_PI * i / face_count;
    return rounded(DVector(apex) + DVector(std::cos(angle), is_flat ? 0 : random.between(-0.5, 0.5), std::sin(angle)));
  };
  const std::uint32_t centre = add_vertex(mesh, apex);
  for (int i = 0; i < face_count; ++i) add_vertex(mesh, rim(i));
  for (int i = 0; i < face_count; ++i) {
    mesh.triangles.push_back(
        {centre, static_cast<std::uint32_t>(1 + i), static_cast<std::uint32_t>(1 + (i + 1) % face_count)});
  }
  return mesh;
}

// From the least floats to the greatest in one scene.
Mesh wild(int face_count, Random& random) {
  Mesh mesh;
  const double least = random.chance(0.5) ? -149 : -60, greatest = random.chance(0.5) ? 127 : 60;
  for (int i = 0; i < face_count; ++i) {
    const double distance = std::pow(2.0, random.between(least, greatest));
    const double size = distance * std::pow(2.0, random.between(-12.0, 0.0));
    const DVector at = distance * random.direction();
    DVector corners[3];
    for (DVector& corner : corners) corner = glm::clamp(at + size * random.in_cube(), -0x1p127, 0x1p127);
    add_triangle(mesh, rounded(corners[0]), rounded(corners[1]), rounded(corners[2]));
  }
  return mesh;
}

Mesh make_mesh(Kind kind, int face_count, Random& random) {
  switch (kind) {
    case Kind::Soup:
      return soup(face_count, random);
    case Kind::Patch:
      return patch(face_count, random);
    case Kind::Slivers:
      return slivers(face_count, random);
    case Kind::Lattice:
      return lattice(face_count, random);
    case Kind::Coplanar:
      return coplanar(face_count, random);
    case Kind::Boxes:
      return boxes(face_count, random);
    case Kind::Ball:
      return ball(face_count, random);
    case Kind::Shell:
      return shell(random);
    case Kind::Fan:
      return fan(face_count, random);
    case Kind::Wild:
      return wild(face_count, random);
  }
  return {};
}

const char* name_of(Kind kind) {
  constexpr const char* kNames[kKindCount] = {"soup",  "patch", "slivers", "lattice", "coplanar",
                                              "boxes", "ball",  "shell",   "fan",     "wild"};
  return kNames[static_cast<int>(kind)];
}

bool is_on_lattice(Kind kind) { return kind == Kind::Lattice || kind == Kind::Coplanar || kind == Kind::Boxes; }

}  // namespace

void add_triangle(Mesh& mesh, const Vector& a, const Vector& b, const Vector& c) {
  const std::uint32_t i = add_vertex(mesh, a), j = add_vertex(mesh, b), k = add_vertex(mesh, c);
  mesh.triangles.push_back({i, j, k});
}

Mesh joined(const Mesh& a, const Mesh& b) {
  Mesh mesh = a;
  const auto first = static_cast<std::uint32_t>(a.positions.size());
  mesh.positions.insert(mesh.positions.end(), b.positions.begin(), b.positions.end());
  for (const Corners& t : b.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return mesh;
}

Mesh box(const Vector& lower, const Vector& upper) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    add_vertex(mesh, {i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z});
  }
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}

Mesh uv_sphere(int slices, int stacks, const DVector& centre, double radius) {
  Mesh mesh;
  add_vertex(mesh, rounded(centre + DVector(0, radius, 0)));
  for (int i = 1; i < stacks; ++i) {
    const double polar = M_PI * i / stacks;
    for (int j = 0; j < slices; ++j) {
      const double azimuth = 2 * M_PI * j / slices;
      const DVector unit(std::sin(polar) * std::sin(azimuth), std::cos(polar), std::sin(polar) * std::cos(azimuth));
      add_vertex(mesh, rounded(centre + radius * unit));
    }
  }
  const std::uint32_t south = add_vertex(mesh, rounded(centre - DVector(0, radius, 0)));
  const auto at = [slices](int stack, int slice) {
    return static_cast<std::uint32_t>(1 + (stack - 1) * slices + slice % slices);
  };
  for (int j = 0; j < slices; ++j) mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
  for (int i = 1; i + 1 < stacks; ++i) {
    for (int j = 0; j < slices; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  for (int j = 0; j < slices; ++j) mesh.triangles.push_back({south, at(stacks - 1, j + 1), at(stacks - 1, j)});
  return mesh;
}

Mesh geodesic_sphere(int splits, const DVector& centre, double radius) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  std::vector<DVector> unit = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                               {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (DVector& v : unit) v = glm::normalize(v);
  Mesh mesh;
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int split = 0; split < splits; ++split) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t i, std::uint32_t j) {
      const auto [at, is_new] = middles.try_emplace(std::minmax(i, j), static_cast<std::uint32_t>(unit.size()));
      if (is_new) unit.push_back(glm::normalize(unit[i] + unit[j]));
      return at->second;
    };
    std::vector<Corners> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t p = middle(a, b), q = middle(b, c), r = middle(c, a);
      finer.insert(finer.end(), {{a, p, r}, {p, b, q}, {r, q, c}, {p, q, r}});
    }
    mesh.triangles = std::move(finer);
  }
  for (const DVector& v : unit) add_vertex(mesh, rounded(centre + radius * v));
  return mesh;
}

Mesh scaled(const Mesh& mesh, float factor) {
  Mesh result = mesh;
  for (Vector& v : result.positions) v *= factor;
  return result;
}

TestScene make_scene(Kind kind, int face_count, Random& random) {
  TestScene scene;
  scene.name = name_of(kind);
  scene.mesh = make_mesh(kind, face_count, random);
  scene.lattice = is_on_lattice(kind) ? 1 : 0;
  scene.radius = 0;
  for (const Vector& v : scene.mesh.positions) scene.radius = std::max(scene.radius, glm::length(DVector(v)));
  return scene;
}

TestScene make_any_scene(Random& random, int largest_face_count) {
  const int face_count = static_cast<int>(std::pow(2.0, random.between(1.0, std::log2(largest_face_count))));
  // Ties are what the last stage is for: scenes on a lattice have most of them.
  const auto kind = static_cast<Kind>(random.below(kKindCount));
  TestScene scene = make_scene(kind, face_count, random);
  if (kind == Kind::Wild) return scene;
  const int placement = random.below(8);
  if (placement <= 1) {
    const float factor = placement == 0 ? 0x1p-40f : 0x1p40f;
    scene.mesh = scaled(scene.mesh, factor);
    scene.radius *= factor;
    scene.lattice *= factor;
    scene.name += placement == 0 ? ", times 2^-40" : ", times 2^40";
  } else if (placement <= 3) {
    scene.centre = Vector(1e6f, -1e6f, 1e6f) * (placement == 2 ? Vector(1) : Vector(1, 0, 0));
    for (Vector& v : scene.mesh.positions) v += scene.centre;
    scene.name += ", 1e6 off";
  }
  return scene;
}

namespace {

Vector any_origin(const TestScene& scene, Random& random) {
  const Mesh& mesh = scene.mesh;
  const int face = random.below(static_cast<int>(mesh.face_count()));
  const Vector a = mesh.vertex(face, 0), b = mesh.vertex(face, 1), c = mesh.vertex(face, 2);
  const DVector centre(scene.centre), towards = random.direction();
  switch (random.below(12)) {
    case 0:
      return a;
    case 1:
      return (a + b) * 0.5f;
    case 2:
      return a + 2.0f * (b - a);  // on an edge's line, outside it
    case 3:
      return a + (b - a) + (c - a);  // on a face's plane, outside it
    case 4:
      return rounded((DVector(a) + DVector(b) + DVector(c)) / 3.0);  // on a face, or as near as floats are
    case 5:
      return scene.centre;
    case 6:
      return rounded(centre + 0.3 * scene.radius * random.in_cube());
    case 7:
      return rounded(centre + std::pow(10.0, random.between(1.0, 5.0)) * scene.radius * towards);
    case 8:
    case 9:
      if (scene.lattice > 0) return scene.centre + static_cast<float>(scene.lattice) * lattice_point(random, 8);
      [[fallthrough]];
    default:
      return rounded(centre + random.between(1.1, 4.0) * scene.radius * towards);
  }
}

}  // namespace

Vector make_origin(const TestScene& scene, Random& random) {
  while (true) {
    const Vector origin = any_origin(scene, random);
    if (std::isfinite(origin.x) && std::isfinite(origin.y) && std::isfinite(origin.z)) return origin;
  }
}

void make_any_kind(const TestScene& scene, Random& random, facemap::Light& light) {
  using facemap::Light;
  const Mesh& mesh = scene.mesh;
  const Vector aim = mesh.vertex(static_cast<std::size_t>(random.below(static_cast<int>(mesh.face_count()))), 0);
  Vector towards = (random.chance(0.5) ? aim : scene.centre) - light.position;
  const float size = std::fabs(towards.x) + std::fabs(towards.y) + std::fabs(towards.z);
  if (!(size > 0 && std::isfinite(size)) || random.chance(0.2)) towards = Vector(random.direction());
  light.direction = towards;
  light.kind = static_cast<Light::Kind>(random.below(3));
  light.outer_angle = random.chance(0.1) ? random.between(0.0, 3.14) : random.between(0.0, 1.0);
  light.inner_angle = light.outer_angle * (random.chance(0.3) ? 1 : random.unit());
  light.has_falloff = random.chance(0.3);
  const double distance =
      std::sqrt(double{towards.x} * towards.x + double{towards.y} * towards.y + double{towards.z} * towards.z);
  if (random.chance(0.3)) light.range = random.between(0.5, 2.0) * distance;
}

}  // namespace test_scenes
