#include "support/queries.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <glm/geometric.hpp>
#include <sstream>

namespace test_queries {
namespace {

using facemap::DVector;
using facemap::Mesh;
using test_scenes::TestScene;

Vector rounded(const DVector& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

float stepped(float value, int ulps) {
  for (; ulps > 0; --ulps) value = std::nextafterf(value, HUGE_VALF);
  for (; ulps < 0; ++ulps) value = std::nextafterf(value, -HUGE_VALF);
  return value;
}

// Half the time as it is, else each component up to 2 ulp off.
Vector nudged(const Vector& v, Random& random) {
  if (random.chance(0.5)) return v;
  const int x = random.between(-2, 2), y = random.between(-2, 2), z = random.between(-2, 2);
  return {stepped(v.x, x), stepped(v.y, y), stepped(v.z, z)};
}

struct Corners {
  DVector a, b, c;
};

Corners corners_of(const Mesh& mesh, int face, Random& random) {
  const int first = random.below(3);
  return {mesh.vertex(face, first), mesh.vertex(face, (first + 1) % 3), mesh.vertex(face, (first + 2) % 3)};
}

int any_face(const Mesh& mesh, Random& random) { return random.below(static_cast<int>(mesh.face_count())); }

// Weights that are exact in floats, or any.
double weight(Random& random) { return random.chance(0.5) ? random.below(9) / 8.0 : random.unit(); }

// On a vertex, an edge, or inside a face.
enum class Spot { Vertex, Edge, Inside };
DVector spot_on(const Corners& f, Spot spot, Random& random) {
  if (spot == Spot::Vertex) return f.a;
  const double p = weight(random);
  if (spot == Spot::Edge) return f.a + p * (f.b - f.a);
  const double q = (1 - p) * weight(random);
  return f.a + p * (f.b - f.a) + q * (f.c - f.a);
}

Spot edge_or_vertex(Random& random) { return random.chance(0.4) ? Spot::Vertex : Spot::Edge; }

// Where the line from `light` through `through` meets the plane of face f.
DVector shadow_on_plane(const Corners& f, const DVector& light, const DVector& through) {
  const DVector n = glm::cross(f.b - f.a, f.c - f.a), d = through - light;
  return light + d * (glm::dot(n, f.a - light) / glm::dot(n, d));
}

bool is_finite(const Vector& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void set_seen(LightQuery& query, const Mesh& mesh, const Vector& camera, const Vector& d, FaceId face, int side) {
  query.is_seen = true;
  query.seen = {camera, d, {mesh.vertex(face, 0), mesh.vertex(face, 1), mesh.vertex(face, 2)}, face, side};
}

// The true point of `face` on a ray to `target`; none if the rounded ray misses the face. Another face may stand
// in front of it.
bool see(LightQuery& query, const oracle::Oracle& oracle, const oracle::View& view, FaceId face, const DVector& target,
         Random& random) {
  const Vector d = nudged(rounded(target - DVector(view.origin())), random);
  if (!is_finite(d) || !view.meets(face, d)) return false;
  set_seen(query, oracle.mesh(), view.origin(), d, face, oracle.side(face, view.origin()));
  return true;
}

// Whatever the camera sees near `target`.
bool see_nearest(LightQuery& query, const oracle::Oracle& oracle, const oracle::View& view, const DVector& target,
                 Random& random) {
  const Vector d = nudged(rounded(target - DVector(view.origin())), random);
  if (!is_finite(d)) return false;
  const oracle::Hit hit = view.nearest(d);
  if (hit.face == facemap::kNoFace) return false;
  set_seen(query, oracle.mesh(), view.origin(), d, hit.face, hit.side);
  return true;
}

void give(LightQuery& query, const TestScene& scene, const oracle::Oracle& oracle, const Vector& light,
          Random& random) {
  const Mesh& mesh = scene.mesh;
  const int face = any_face(mesh, random);
  const Corners f = corners_of(mesh, face, random);
  query.is_aimed = true;
  DVector at(0);
  switch (random.below(8)) {
    case 0:  // on a face's edge or vertex
      at = spot_on(f, edge_or_vertex(random), random);
      break;
    case 1:  // on a face
      at = spot_on(f, Spot::Inside, random);
      break;
    case 2: {  // in line with an edge or vertex of a face, often just at it
      const double stretch = random.chance(0.3) ? 2.0 : random.between(0.5, 3.0);
      at = DVector(light) + stretch * (spot_on(f, edge_or_vertex(random), random) - DVector(light));
      break;
    }
    case 3: {  // the shadow of a vertex on another face's plane
      const Corners g = corners_of(mesh, any_face(mesh, random), random);
      at = shadow_on_plane(f, light, spot_on(g, edge_or_vertex(random), random));
      break;
    }
    case 4: {  // on a face's plane, outside it
      const double p = random.between(-2, 3), q = random.between(-2, 3);
      at = f.a + p * (f.b - f.a) + q * (f.c - f.a);
      break;
    }
    case 5:  // sampled from a face: it is named
      at = spot_on(f, random.chance(0.5) ? edge_or_vertex(random) : Spot::Inside, random);
      if (oracle.is_kept(face)) query.on.face = face;
      break;
    case 6: {  // sampled from a surface: so and so far off it
      at = spot_on(f, Spot::Inside, random);
      const double size = std::max({std::fabs(at.x), std::fabs(at.y), std::fabs(at.z)});
      query.on.tolerance = static_cast<float>(size * std::pow(2.0, random.between(-26, -18)));
      break;
    }
    default:
      at = random.chance(0.05) ? DVector(light) : DVector(scene.centre) + 2.0 * scene.radius * random.in_cube();
      query.is_aimed = false;
  }
  query.given = query.is_aimed ? nudged(rounded(at), random) : rounded(at);
  if (!is_finite(query.given)) query = LightQuery();  // a shadow that falls at infinity
}

CameraQuery any_camera_query(const TestScene& scene, const Vector& camera, Random& random) {
  const Corners f = corners_of(scene.mesh, any_face(scene.mesh, random), random);
  const DVector K(camera);
  switch (random.below(8)) {
    case 0:
    case 1:
      return {nudged(rounded(f.a - K), random), true};
    case 2:
      return {nudged(rounded(f.a + f.b - 2.0 * K), random), true};  // towards the edge's midpoint
    case 3:
      return {nudged(rounded(spot_on(f, Spot::Edge, random) - K), random), true};
    case 4: {
      const double p = random.between(1, 4), q = random.between(1, 4);
      return {nudged(rounded(p * (f.a - K) + q * (f.b - K)), random), true};
    }
    case 5: {  // along an axis or a diagonal
      const int x = random.between(-1, 1), y = random.between(-1, 1), z = random.between(-1, 1);
      return {nudged(Vector(x, y, z), random), true};
    }
    case 6:
      return {rounded(spot_on(f, Spot::Inside, random) - K), false};
    default:
      return {rounded(random.direction()), false};
  }
}

}  // namespace

CameraQuery make_camera_query(const TestScene& scene, const Vector& camera, Random& random) {
  const CameraQuery query = any_camera_query(scene, camera, random);
  return is_finite(query.direction) ? query : CameraQuery{Vector(1, 2, 3), false};  // farther than floats reach
}

LightQuery make_light_query(const TestScene& scene, const oracle::Oracle& oracle, const oracle::View& view,
                            const Vector& light, Random& random) {
  const Mesh& mesh = scene.mesh;
  LightQuery query;
  query.is_aimed = true;
  const int face = any_face(mesh, random);
  const Corners f = corners_of(mesh, face, random);
  bool is_seen = false;
  switch (random.below(6)) {
    case 0:  // on an edge or vertex of its own face
      is_seen = see(query, oracle, view, face, spot_on(f, edge_or_vertex(random), random), random);
      break;
    case 1: {  // in line with an edge or vertex of another face
      const Corners g = corners_of(mesh, any_face(mesh, random), random);
      const DVector through = spot_on(g, edge_or_vertex(random), random);
      is_seen = see(query, oracle, view, face, shadow_on_plane(f, light, through), random);
      break;
    }
    case 2:
      is_seen = see_nearest(query, oracle, view, spot_on(f, edge_or_vertex(random), random), random);
      break;
    case 3:
      is_seen = see_nearest(query, oracle, view, spot_on(f, Spot::Inside, random), random);
      query.is_aimed = false;
      break;
    default:
      break;
  }
  if (!is_seen) give(query, scene, oracle, light, random);
  return query;
}

std::string text(const Vector& v) {
  char buffer[128];
  std::snprintf(buffer, sizeof buffer, "(%a %a %a) = (%.9g %.9g %.9g)", double(v.x), double(v.y), double(v.z),
                double(v.x), double(v.y), double(v.z));
  return buffer;
}

std::string text(const LightQuery& query) {
  std::ostringstream out;
  if (query.is_seen) {
    out << "seen from " << text(query.seen.origin) << " along " << text(query.seen.direction) << " on face "
        << query.seen.face;
  } else {
    out << "given " << text(query.given) << " on face " << query.on.face << ", tolerance " << query.on.tolerance;
  }
  return out.str();
}

std::string write_failure(const Mesh& mesh, const std::string& query) {
  static std::atomic<int> number = 0;
  const auto stem = std::filesystem::temp_directory_path() / ("facemap-failure-" + std::to_string(++number));
  std::ofstream obj(stem.string() + ".obj");
  obj.precision(9);  // enough for a float32 to come back the same
  for (const Vector& v : mesh.positions) obj << "v " << v.x << ' ' << v.y << ' ' << v.z << '\n';
  for (const auto& t : mesh.triangles) obj << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  std::ofstream(stem.string() + ".txt") << query << '\n';
  return "scene and query written to " + stem.string() + ".obj, .txt";
}

}  // namespace test_queries
