#include "render/shade_batch.h"

#include <facemap/error.h>

#include <algorithm>
#include <cmath>

#include "map/face_planes.h"
#include "math/exact_sign.h"
#include "render/shade.h"

namespace facemap {
namespace {

bool is_finite(const Vector& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

ShadeBatch::ShadeBatch(const Scene& scene, const Vector& camera, const RayTable& rays, bool smooth)
    : scene_(scene), camera_(camera), table_(rays), smooth_(smooth), slots_(scene.mesh()) {}

void ShadeBatch::take(const AskedPoints& points, std::size_t first, std::size_t count) {
  rays_.count = count;
  slots_.assign(points.faces.data() + first, count, rays_.slots);
  set_up_rays(points, first);
  set_up_faces();
}

void ShadeBatch::find_surfaces(bool smooth) {
  const float K[3] = {camera_.x, camera_.y, camera_.z};
  simd::find_surfaces(slots_.planes, faces_, rays_, K, smooth, points_);
}

void ShadeBatch::set_up_rays(const AskedPoints& points, std::size_t first) {
  const auto columns = static_cast<std::uint32_t>(table_.columns.size());
  for (std::size_t i = 0; i < rays_.count; ++i) {
    const std::uint32_t sample = points.samples[first + i];
    rays_.map_x[i] = table_.columns[sample % columns];
    rays_.map_y[i] = table_.rows[sample / columns];
  }
  simd::ray_directions(table_.frame, rays_.map_x, rays_.map_y, rays_.count, rays_.direction[0], rays_.direction[1],
                       rays_.direction[2]);
}

void ShadeBatch::set_up_faces() {
  simd::PlaneBatch& planes = slots_.planes;
  const float K[3] = {camera_.x, camera_.y, camera_.z};
  simd::set_up_planes(planes, K);
  simd::place_corners(planes, faces_);
  for (std::size_t slot = 0; slot < planes.count; ++slot) {
    const std::uint32_t face = slots_.faces[slot];
    if (faces_.side[slot] == 0) faces_.side[slot] = side(triangle_of(scene_, face), camera_);
    if (!smooth_) continue;
    const Face corners = scene_.mesh().face(face);
    for (std::size_t k = 0; k < 3; ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        faces_.file_normals[3 * k + static_cast<std::size_t>(axis)][slot] = corners.normals[k][axis];
      }
    }
  }
  simd::orient_faces(planes, smooth_, faces_);
}

bool ShadeBatch::is_moved(std::size_t i, const Vector& position) const {
  if (points_.lift[i] != simd::kUnsureLift) return points_.lift[i] == simd::kLifted;
  const auto slot = static_cast<std::size_t>(rays_.slots[i]);
  return side(triangle_of(scene_, slots_.faces[slot]), position) == static_cast<int>(faces_.side[slot]);
}

void ShadeBatch::find_moved(std::size_t first, std::vector<MovedPoint>& moved) {
  find_surfaces(false);  // find_lifts needs no normals
  if (!simd::find_lifts(slots_.planes, faces_, rays_, Shader::kLeastLift, points_)) return;
  for (std::size_t i = 0; i < rays_.count; ++i) {
    if (points_.lift[i] == simd::kNoLift) continue;
    const Vector position(static_cast<float>(points_.moved[0][i]), static_cast<float>(points_.moved[1][i]),
                          static_cast<float>(points_.moved[2][i]));
    if (!is_moved(i, position)) continue;
    if (!is_finite(position)) throw Error("a point lifted for smooth shading is beyond the range of float32");
    moved.push_back({position, static_cast<std::uint32_t>(first + i)});
  }
}

// The numerator of Shader::shade's cosine, in the same order: where it is not above 0 neither is the cosine.
bool ShadeBatch::may_add(const simd::LightSource& light, std::size_t i) const {
  const double x = light.position[0] - points_.position[0][i], y = light.position[1] - points_.position[1][i],
               z = light.position[2] - points_.position[2][i];
  return points_.normal[0][i] * x + points_.normal[1][i] * y + points_.normal[2][i] * z > 0;
}

void ShadeBatch::shade(const std::vector<simd::LightSource>& lights, bool inverse_square, const std::uint8_t* masks,
                       std::size_t stride) {
  find_surfaces(smooth_);
  for (auto& component : points_.radiance) std::fill_n(component, rays_.count, 0.0);
  for (std::size_t byte = 0; byte < stride; ++byte) {
    for (std::size_t i = 0; i < rays_.count; ++i) lit_[i] = masks[i * stride + byte];
    const std::size_t first = byte * 8;
    const int count = static_cast<int>(std::min<std::size_t>(8, lights.size() - first));
    simd::add_lights(lights.data() + first, count, inverse_square, lit_, rays_.count, points_);
  }
}

void ShadeBatch::store_colors(const std::uint32_t* samples, std::span<Color> colors) const {
  for (std::size_t i = 0; i < rays_.count; ++i) {
    colors[samples[i]] = {static_cast<float>(points_.radiance[0][i]), static_cast<float>(points_.radiance[1][i]),
                          static_cast<float>(points_.radiance[2][i])};
  }
}

}  // namespace facemap
