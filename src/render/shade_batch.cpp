#include "render/shade_batch.h"

#include <facemap/error.h>

#include <algorithm>
#include <cmath>

#include "map/face_planes.h"
#include "math/exact_sign.h"
#include "render/shade.h"

namespace facemap {
namespace {

// A normal at each corner.
bool has_all(const Corners& normals) { return std::max({normals[0], normals[1], normals[2]}) != kNoIndex; }

bool is_finite(const Vector& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

DVector at(const double (&numbers)[3][simd::kSeenBatch], std::size_t i) {
  return {numbers[0][i], numbers[1][i], numbers[2][i]};
}

void store(const DVector& v, double (&numbers)[3][simd::kSeenBatch], std::size_t i) {
  for (int k = 0; k < 3; ++k) numbers[k][i] = v[k];
}

}  // namespace

ShadeBatch::ShadeBatch(const Scene& scene, const SampleGrid& grid, const RayTable& rays, bool smooth,
                       const MaterialTable* materials)
    : scene_(scene),
      camera_(grid.frame.position()),
      table_(rays),
      materials_(materials),
      neighbours_(materials == nullptr ? nullptr : std::make_unique<NeighbourRays>(grid)),
      smooth_(smooth && !scene.mesh().normal_corners.empty()),
      slots_(scene.mesh()) {}

std::size_t ShadeBatch::take(const AskedPoints& points, std::size_t first, std::size_t end) {
  rays_.count = std::min(simd::kSeenBatch, end - first);
  for (std::size_t i = 0; i < rays_.count; ++i) numbers_[i] = static_cast<std::uint32_t>(first + i);
  std::copy_n(points.samples.data() + first, rays_.count, samples_);
  std::copy_n(points.faces.data() + first, rays_.count, face_ids_);
  set_up();
  return rays_.count;
}

std::size_t ShadeBatch::take_smooth(const AskedPoints& points, std::size_t first, std::size_t end) {
  rays_.count = 0;
  if (!smooth_) return end;
  const std::vector<Corners>& normal_corners = scene_.mesh().normal_corners;
  std::uint32_t last = kNoOwnFace;
  bool last_has_normals = false;
  std::size_t i = first;
  for (; i < end && rays_.count < simd::kSeenBatch; ++i) {
    const std::uint32_t face = points.faces[i];
    if (face != last) last_has_normals = has_all(normal_corners[face]);
    last = face;
    if (!last_has_normals) continue;
    numbers_[rays_.count] = static_cast<std::uint32_t>(i);
    samples_[rays_.count] = points.samples[i];
    face_ids_[rays_.count++] = face;
  }
  set_up();
  return i;
}

void ShadeBatch::take(const std::uint32_t* samples, const std::uint32_t* faces, std::size_t count) {
  rays_.count = count;
  std::copy_n(samples, count, samples_);
  std::copy_n(faces, count, face_ids_);
  set_up();
}

void ShadeBatch::set_up() {
  slots_.assign(face_ids_, rays_.count, rays_.slots);
  set_up_rays();
  set_up_faces();
}

void ShadeBatch::set_up_rays() {
  const auto columns = static_cast<std::uint32_t>(table_.columns.size());
  std::uint32_t row = 0, begin = 0;  // its first sample
  for (std::size_t i = 0; i < rays_.count; ++i) {
    const std::uint32_t sample = samples_[i];
    if (sample - begin >= columns) {
      row = sample / columns;
      begin = row * columns;
    }
    rays_.map_x[i] = table_.columns[sample - begin];
    rays_.map_y[i] = table_.rows[row];
  }
  table_.find_directions(samples_, rays_);
}

void ShadeBatch::set_up_faces() {
  simd::PlaneBatch& planes = slots_.planes;
  const float K[3] = {camera_.x, camera_.y, camera_.z};
  simd::set_up_planes(planes, K);
  simd::place_corners(planes, faces_);
  for (std::size_t slot = 0; slot < planes.count; ++slot) {
    if (faces_.side[slot] == 0) faces_.side[slot] = side(triangle_of(scene_, slots_.faces[slot]), camera_);
  }
  some_smooth_ = false;
  if (smooth_) set_normals();
  simd::orient_faces(planes, some_smooth_, faces_);
}

// As Mesh::face gives them; a face that lacks one is not smooth, and gets none.
void ShadeBatch::set_normals() {
  const Mesh& mesh = scene_.mesh();
  const std::size_t count = slots_.planes.count;
  for (std::size_t slot = 0; slot < count; ++slot) {
    normal_corners_[slot] = mesh.normal_corners[slots_.faces[slot]];
    some_smooth_ = some_smooth_ || has_all(normal_corners_[slot]);
  }
  if (!some_smooth_) return;
  for (std::size_t slot = 0; slot < count; ++slot) {
    const bool given = has_all(normal_corners_[slot]);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector normal = given ? mesh.normals[normal_corners_[slot][k]] : Vector(0);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        faces_.file_normals[3 * k + axis][slot] = normal[static_cast<int>(axis)];
      }
    }
  }
}

void ShadeBatch::find_surfaces(bool smooth) {
  const float K[3] = {camera_.x, camera_.y, camera_.z};
  simd::find_surfaces(slots_.planes, faces_, rays_, K, smooth, points_);
}

bool ShadeBatch::is_moved(std::size_t i, const Vector& position) const {
  if (points_.lift[i] != simd::kUnsureLift) return points_.lift[i] == simd::kLifted;
  const auto slot = static_cast<std::size_t>(rays_.slots[i]);
  return side(triangle_of(scene_, slots_.faces[slot]), position) == static_cast<int>(faces_.side[slot]);
}

void ShadeBatch::find_moved(std::vector<MovedPoint>& moved) {
  moved_count_ = 0;
  if (rays_.count == 0) return;
  find_surfaces(false);  // find_lifts needs no normals
  if (!simd::find_lifts(slots_.planes, faces_, rays_, Shader::kLeastLift, points_)) return;
  for (std::size_t i = 0; i < rays_.count; ++i) {
    if (points_.lift[i] == simd::kNoLift) continue;
    const Vector position(static_cast<float>(points_.moved[0][i]), static_cast<float>(points_.moved[1][i]),
                          static_cast<float>(points_.moved[2][i]));
    if (!is_moved(i, position)) continue;
    if (!is_finite(position)) throw Error("a point lifted for smooth shading is beyond the range of float32");
    moved.push_back({position, numbers_[i]});
    moved_places_[moved_count_++] = static_cast<std::uint32_t>(i);
  }
}

void ShadeBatch::find_lights_of_moved(const std::vector<simd::LightSource>& lights, std::uint8_t* masks,
                                      std::size_t stride) {
  if (moved_count_ == 0) return;
  simd::find_smooth_normals(faces_, rays_, points_);
  for (std::size_t byte = 0; byte < stride; ++byte) {
    const std::size_t first = byte * 8;
    const int count = static_cast<int>(std::min<std::size_t>(8, lights.size() - first));
    simd::find_lights_before(lights.data() + first, count, rays_.count, points_, lit_);
    for (std::size_t k = 0; k < moved_count_; ++k) {
      masks[k * stride + byte] = static_cast<std::uint8_t>(lit_[moved_places_[k]]);
    }
  }
}

void ShadeBatch::keep_lights_before(const std::vector<simd::LightSource>& lights, std::uint8_t* masks,
                                    std::size_t stride) {
  for (std::size_t byte = 0; byte < stride; ++byte) {
    const std::size_t first = byte * 8;
    const int count = static_cast<int>(std::min<std::size_t>(8, lights.size() - first));
    simd::find_lights_before(lights.data() + first, count, rays_.count, points_, lit_);
    for (std::size_t i = 0; i < rays_.count; ++i) {
      std::uint8_t& mask = masks[i * stride + byte];
      mask = static_cast<std::uint8_t>(mask & lit_[i]);
    }
  }
}

void ShadeBatch::clear_unreached(const std::vector<simd::LightSource>& lights, std::uint8_t* masks,
                                 std::size_t stride) {
  find_surfaces(false);
  for (std::size_t byte = 0; byte < stride; ++byte) {
    const std::size_t first = byte * 8;
    const int count = static_cast<int>(std::min<std::size_t>(8, lights.size() - first));
    if (std::none_of(lights.data() + first, lights.data() + first + count, is_windowed)) continue;
    simd::find_lights_reaching(lights.data() + first, count, rays_.count, points_, lit_);
    for (std::size_t i = 0; i < rays_.count; ++i) masks[i * stride + byte] &= static_cast<std::uint8_t>(lit_[i]);
  }
}

void ShadeBatch::shade(const std::vector<simd::LightSource>& lights, const Surroundings& surroundings,
                       const std::uint8_t* masks, std::size_t stride) {
  find_surfaces(some_smooth_);
  if (materials_ == nullptr) {
    shade_white(lights, surroundings, masks, stride);
  } else {
    shade_materials(lights, surroundings, masks, stride);
  }
}

void ShadeBatch::shade_white(const std::vector<simd::LightSource>& lights, const Surroundings& surroundings,
                             const std::uint8_t* masks, std::size_t stride) {
  for (auto& component : points_.radiance) std::fill_n(component, rays_.count, 0.0);
  for (std::size_t i = 0; i < rays_.count && !surroundings.are_dark(); ++i) {
    store(surroundings.at(at(points_.normal, i)), points_.radiance, i);
  }
  for (std::size_t byte = 0; byte < stride; ++byte) {
    for (std::size_t i = 0; i < rays_.count; ++i) lit_[i] = masks[i * stride + byte];
    const std::size_t first = byte * 8;
    const int count = static_cast<int>(std::min<std::size_t>(8, lights.size() - first));
    simd::add_lights(lights.data() + first, count, lit_, rays_.count, points_);
  }
}

// Textures are filtered by the rays beside each.
bool ShadeBatch::find_neighbours() {
  if (materials_ == nullptr) return false;
  const auto has_textures = [&](std::uint32_t face) { return materials_->has_textures(face); };
  if (std::none_of(slots_.faces, slots_.faces + slots_.planes.count, has_textures)) return false;
  neighbours_->find(table_.frame, samples_, rays_);
  return true;
}

SeenSurface ShadeBatch::seen_surface(std::size_t i, bool has_neighbours) const {
  SeenSurface seen;
  seen.face = face_ids_[i];
  seen.weights = at(points_.weights, i);
  seen.normal = at(points_.normal, i);
  seen.is_behind = faces_.side[rays_.slots[i]] > 0;
  seen.camera = DVector(camera_);
  seen.rays.through = Vector(rays_.direction[0][i], rays_.direction[1][i], rays_.direction[2][i]);
  if (has_neighbours) seen.rays = neighbours_->bundle(rays_, i);
  return seen;
}

// Point by point, in the words of Shader::material_radiance.
void ShadeBatch::shade_materials(const std::vector<simd::LightSource>& lights, const Surroundings& surroundings,
                                 const std::uint8_t* masks, std::size_t stride) {
  const bool has_neighbours = find_neighbours();
  for (std::size_t i = 0; i < rays_.count; ++i) {
    const SeenSurface seen = seen_surface(i, has_neighbours);
    const SurfaceLook look = materials_->look(seen, frame_);
    LitSurface lit(seen, look, at(points_.position, i), surroundings);
    for (std::size_t l = 0; l < lights.size(); ++l) {
      if ((masks[i * stride + l / 8] >> (l % 8) & 1) == 0) continue;
      lit.add(lights[l]);
    }
    store(lit.radiance(), points_.radiance, i);
  }
}

void ShadeBatch::for_each_surface(const std::function<void(const ShadedSurface&)>& see) {
  find_surfaces(some_smooth_);
  const bool has_neighbours = find_neighbours();
  for (std::size_t i = 0; i < rays_.count; ++i) {
    ShadedSurface surface{samples_[i], seen_surface(i, has_neighbours), {}};
    surface.look.normal = surface.seen.normal;
    if (materials_ != nullptr) surface.look = materials_->look(surface.seen, frame_);
    see(surface);
  }
}

void ShadeBatch::store_in_order(Color* colors) const {
  for (std::size_t i = 0; i < rays_.count; ++i) {
    colors[i] = {static_cast<float>(points_.radiance[0][i]), static_cast<float>(points_.radiance[1][i]),
                 static_cast<float>(points_.radiance[2][i])};
  }
}

void ShadeBatch::store_colors(std::span<Color> colors) const {
  for (std::size_t i = 0; i < rays_.count; ++i) {
    colors[samples_[i]] = {static_cast<float>(points_.radiance[0][i]), static_cast<float>(points_.radiance[1][i]),
                           static_cast<float>(points_.radiance[2][i])};
  }
}

}  // namespace facemap
