#include "facemap_bench_limit.h"

#include <facemap/projection.h>
#include <facemap/space_vector.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "facemap_bench_clock.h"

namespace facemap::bench {
namespace {

constexpr int kTexels = 128;  // a side of the map
constexpr int kBatch = 256;

/// The four planes of the cone of a face and of the face itself, seen from a light, component by component: a point
/// at D from the light is behind the face if all four of n . D - offset are at least 0.
struct alignas(64) Planes {
  float x[4], y[4], z[4], offset[4];
};

Planes planes_of(const Mesh& mesh, std::size_t face, const Vector& light) {
  const Vector a = mesh.vertex(face, 0) - light, b = mesh.vertex(face, 1) - light, c = mesh.vertex(face, 2) - light;
  Vector normals[4] = {glm::cross(a, b - a), glm::cross(b, c - b), glm::cross(c, a - c), glm::cross(b - a, c - a)};
  const float side = glm::dot(normals[3], a) < 0 ? -1.0f : 1.0f;
  Planes planes{};
  for (int i = 0; i < 4; ++i) {
    planes.x[i] = side * normals[i].x;
    planes.y[i] = side * normals[i].y;
    planes.z[i] = side * normals[i].z;
  }
  planes.offset[3] = side * glm::dot(normals[3], a);
  return planes;
}

/// All questions to one light: points from it, and the face that decides each or none.
struct Questions {
  std::vector<float> x, y, z;
  std::vector<FaceId> deciding;
  std::vector<Planes> planes;  ///< one a face
  std::vector<std::uint32_t> texel_starts;
  Vector right{0}, up{0}, sight{0};
};

/// The points of a picture with the faces they lie on.
struct Seen {
  std::vector<Vector> points;
  std::vector<std::size_t> samples;
};

Seen seen_points(const Case& question, const View& view, const Image& answer, int samples) {
  const Projection projection(view.projection, view.field_angle, answer.width / samples, answer.height / samples);
  const SpaceVector frame = SpaceVector::looking_at(view.position, view.look_at, view.up);
  const Mesh& mesh = question.scene.mesh();
  Seen seen;
  for (std::size_t i = 0; i < answer.ids.size(); ++i) {
    if (answer.ids[i] == kNoFace) continue;
    const auto columns = static_cast<std::size_t>(answer.width);
    const MapPoint at((double(i % columns) + 0.5) / samples, (double(i / columns) + 0.5) / samples);
    const DVector d = frame.world_from_local(projection.local_from_map(at));
    const auto face = static_cast<std::size_t>(answer.ids[i]);
    const DVector a(mesh.vertex(face, 0)), b(mesh.vertex(face, 1)), c(mesh.vertex(face, 2)), eye(view.position);
    const DVector n = glm::cross(b - a, c - a);
    seen.points.push_back(Vector(eye + d * (glm::dot(n, a - eye) / glm::dot(n, d))));
    seen.samples.push_back(i);
  }
  return seen;
}

bool is_in_front(const Mesh& mesh, FaceId face, const Vector& eye, const Vector& light) {
  const auto f = static_cast<std::size_t>(face);
  const DVector a(mesh.vertex(f, 0)), n = glm::cross(DVector(mesh.vertex(f, 1)) - a, DVector(mesh.vertex(f, 2)) - a);
  return glm::dot(n, DVector(eye) - a) * glm::dot(n, DVector(light) - a) > 0;
}

Questions questions_to(std::size_t number, const Case& question, const View& view, const Image& answer,
                       const Seen& seen, const Embree& embree) {
  const Vector light = question.lights[number].position;
  const Mesh& mesh = question.scene.mesh();
  Questions made;
  const SpaceVector frame = SpaceVector::looking_along(light, question.scene.centre() - DVector(light));
  made.right = Vector(frame.axis_x());
  made.up = Vector(frame.axis_y());
  made.sight = Vector(frame.axis_z());
  made.texel_starts.assign(kTexels * kTexels, 0);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) made.planes.push_back(planes_of(mesh, f, light));
  for (std::size_t i = 0; i < seen.points.size(); ++i) {
    const FaceId own = answer.ids[seen.samples[i]];
    if (!is_in_front(mesh, own, view.position, light)) continue;
    const std::uint8_t mask = answer.lights[seen.samples[i] * std::size_t(answer.light_bytes()) + number / 8];
    const bool lit = ((mask >> number % 8) & 1) != 0;
    const Vector d = seen.points[i] - light;
    made.x.push_back(d.x);
    made.y.push_back(d.y);
    made.z.push_back(d.z);
    made.deciding.push_back(lit ? kNoFace : embree.first_face(light, d));
  }
  return made;
}

/// How many points are hidden; asks each as a map would.
std::size_t ask(const Questions& q) {
  const float scale = kTexels * 0.4f, middle = kTexels * 0.5f, last = kTexels - 1;
  const Vector right = q.right, up = q.up, sight = q.sight;
  std::uint32_t texels[kBatch];
  std::size_t hidden = 0;
  for (std::size_t first = 0; first < q.x.size(); first += kBatch) {
    const std::size_t count = std::min<std::size_t>(kBatch, q.x.size() - first);
    const float *x = q.x.data() + first, *y = q.y.data() + first, *z = q.z.data() + first;
    for (std::size_t i = 0; i < count; ++i) {
      const float depth = x[i] * sight.x + y[i] * sight.y + z[i] * sight.z;
      const float inverse = scale / depth;
      const float u = middle + (x[i] * right.x + y[i] * right.y + z[i] * right.z) * inverse;
      const float v = middle - (x[i] * up.x + y[i] * up.y + z[i] * up.z) * inverse;
      const float column = std::max(0.0f, std::min(u, last)), row = std::max(0.0f, std::min(v, last));
      texels[i] = std::uint32_t(int(row) * kTexels + int(column));
    }
    for (std::size_t i = 0; i < count; ++i) {
      const FaceId face = q.deciding[first + q.texel_starts[texels[i]] + i];
      if (face == kNoFace) continue;
      const Planes& p = q.planes[std::size_t(face)];
      bool behind = true;
      for (int k = 0; k < 4; ++k) behind &= p.x[k] * x[i] + p.y[k] * y[i] + p.z[k] * z[i] - p.offset[k] >= 0;
      hidden += behind;
    }
  }
  return hidden;
}

}  // namespace

double limit_ns(const Case& question, const View& view, const Image& answer, const Embree& embree, int samples,
                int repeat) {
  const Seen seen = seen_points(question, view, answer, samples);
  double ms = 0;
  std::size_t queries = 0;
  volatile std::size_t hidden = 0;  // so that the work is done
  for (std::size_t l = 0; l < question.lights.size(); ++l) {
    const Questions asked = questions_to(l, question, view, answer, seen, embree);
    double best = std::numeric_limits<double>::infinity();
    for (int round = 0; round < repeat; ++round) {
      const Stopwatch watch(Time::Thread);
      hidden = hidden + ask(asked);
      best = std::min(best, watch.milliseconds());
    }
    ms += best;
    queries += asked.x.size();
  }
  return queries ? ms * 1e6 / double(queries) : 0;
}

}  // namespace facemap::bench
