#include <facemap/error.h>
#include <facemap/point_light.h>

#include <algorithm>
#include <cmath>

#include "map/cover.h"
#include "map/face_planes.h"
#include "map/light_projection.h"
#include "map/list_point.h"
#include "map/map_faces.h"
#include "map/texels.h"
#include "math/dvector.h"
#include "simd/floating_point_mode.h"
#include "simd/list_points.h"

namespace facemap {
namespace {

constexpr const char* kNotFinite = "a point to be lit is not finite";

constexpr std::uint32_t kSkipNone = 0xffffffffu;

// Whether what the filter takes for a blocker is one: not if it may be within a tolerance.
bool is_far_enough(const TruePoint&) { return true; }
bool is_far_enough(const GivenPoint& point) { return point.tolerance == 0; }

// Faces of a list that are asked before the undecided among them are asked exactly.
constexpr std::size_t kFewFaces = 64;

// Unused places are the world's origin.
void load(std::span<const Vector> points, simd::PointChunk& chunk) {
  float sum = 0;  // 0 times what is finite
  for (std::size_t i = 0; i < points.size(); ++i) {
    chunk.x[i] = points[i].x;
    chunk.y[i] = points[i].y;
    chunk.z[i] = points[i].z;
    sum += 0 * points[i].x + 0 * points[i].y + 0 * points[i].z;
  }
  if (!(sum == 0)) throw Error(kNotFinite);
  for (std::size_t i = points.size(); i < simd::kChunk; ++i) chunk.x[i] = chunk.y[i] = chunk.z[i] = 0;
}

simd::PlaneMap plane_map_of(const SpaceVector& frame, const Projection& projection) {
  simd::PlaneMap map;
  for (int i = 0; i < 3; ++i) {
    map.axis_x[i] = frame.axis_x()[i];
    map.axis_y[i] = frame.axis_y()[i];
    map.axis_z[i] = frame.axis_z()[i];
  }
  map.texel_angle = projection.texel_angle();
  map.width = projection.width();
  map.height = projection.height();
  return map;
}

}  // namespace

PointLight::PointLight(const Scene& scene, const Vector& position, const Options& options)
    : PointLight(map_faces(scene, options.cut_outs, options.max_texture_pixels), position, options) {}

PointLight::PointLight(const MapFaces& faces, const Vector& position, const Options& options)
    : PointLight(faces, SpaceVector::looking_along(position, sight_of_light(faces.all(), position)), options) {}

PointLight::PointLight(const MapFaces& faces, const SpaceVector& frame, const Options& options)
    : FaceMap(faces, frame, light_projection(faces.all(), frame, options), options.builder, options.keep_all) {}

template <class Point>
bool PointLight::is_blocked(const DVector& offset, const Point& point, std::uint32_t skip, float tolerance,
                            Counters* counters) const {
  const std::optional<Texel> texel = texel_of(offset);
  if (!texel) return false;
  const std::size_t texel_index =
      static_cast<std::size_t>(texel->y) * static_cast<std::size_t>(width()) + static_cast<std::size_t>(texel->x);
  const std::span<const std::uint32_t> ids = texels().faces_at(texel_index);
  const double scale = planes().scale();
  const double true_length = length(offset) * scale;
  const bool is_past_cut = is_beyond(true_length, texels().cut(texel_index));
  const auto exact = [&](std::uint32_t id) {
    return blocks(triangle_of(scene(), id), planes().side(id), position(), point, counters);
  };

  if (!(true_length < simd::kLargestOffset)) return is_blocked_for_sure(ids, is_past_cut, skip, exact);
  const simd::ListPoint asked = list_point(offset * scale, true_length);
  if (tolerance > 0) {
    // What the filter takes for a blocker may be within the tolerance.
    return is_blocked_for_sure(ids, is_past_cut, skip, [&](std::uint32_t id) {
      std::uint32_t undecided;
      const simd::BlockWalk walk = simd::find_blocker(planes().planes(), &id, 1, asked, kSkipNone, &undecided);
      return (walk.blocked || walk.undecided > 0) && exact(id);
    });
  }
  if (is_past_cut) {
    if (counters != nullptr) ++counters->by_float;
    return true;
  }
  std::uint32_t undecided[kFewFaces];
  for (std::size_t first = 0; first < ids.size(); first += kFewFaces) {
    const simd::BlockWalk walk = simd::find_blocker(planes().planes(), ids.data() + first,
                                                    std::min(kFewFaces, ids.size() - first), asked, skip, undecided);
    if (counters != nullptr) counters->by_float += walk.tested - walk.undecided;
    if (walk.blocked || std::any_of(undecided, undecided + walk.undecided, exact)) return true;
    if (walk.ended) return false;
  }
  return false;
}

// Each face is asked by itself: behind one with a hole the next may block.
template <class Point>
bool PointLight::is_blocked_by_cut_outs(const DVector& offset, const Point& point, const DVector& place,
                                        std::uint32_t skip, Counters* counters) const {
  const std::optional<Texel> texel = has_cut_outs() ? texel_of(offset) : std::nullopt;
  if (!texel) return false;
  const double length_in_map = length(offset) * planes().scale();
  const bool is_for_filter = length_in_map < simd::kLargestOffset;
  const simd::ListPoint asked =
      is_for_filter ? list_point(offset * planes().scale(), length_in_map) : simd::ListPoint();
  const DVector towards = DVector(position()) - place;
  for (const std::uint32_t id : cut_outs_at(texel->x, texel->y)) {
    if (id == skip) continue;
    if (is_for_filter) {
      std::uint32_t undecided;
      const simd::BlockWalk walk = simd::find_blocker(planes().planes(), &id, 1, asked, kSkipNone, &undecided);
      if (walk.ended) return false;
      if (counters != nullptr) counters->by_float += walk.tested - walk.undecided;
      if (!walk.blocked && walk.undecided == 0) continue;
      if (walk.blocked && is_far_enough(point) && cut_outs().is_there(id, place, towards)) return true;
      if (walk.blocked && is_far_enough(point)) continue;
    }
    if (blocks(triangle_of(scene(), id), planes().side(id), position(), point, counters) &&
        cut_outs().is_there(id, place, towards)) {
      return true;
    }
  }
  return false;
}

// A list that `is_cut` is not complete for this point: then every face of the scene is asked besides.
template <class Predicate>
bool PointLight::is_blocked_for_sure(std::span<const std::uint32_t> ids, bool is_cut, std::uint32_t skip,
                                     const Predicate& blocks) const {
  const auto blocks_other = [&](std::uint32_t id) { return id != skip && blocks(id); };
  if (std::any_of(ids.begin(), ids.end(), blocks_other)) return true;
  const std::vector<std::uint32_t>& all = solid_faces().kept_faces();
  return is_cut && std::any_of(all.begin(), all.end(), blocks_other);
}

void PointLight::get_lighten_up(std::span<const Vector> points, std::span<std::uint8_t> lit, Counters* counters) const {
  const FloatingPointMode mode;
  if (lit.size() != points.size()) throw Error("as many answers as points are needed");
  for (std::size_t first = 0; first < points.size(); first += simd::kChunk) {
    ask_together(points.subspan(first, std::min(simd::kChunk, points.size() - first)), lit.data() + first, counters);
  }
}

void PointLight::ask_together(std::span<const Vector> points, std::uint8_t* lit, Counters* counters) const {
  simd::PointChunk chunk;
  load(points, chunk);
  const Vector& O = position();
  const double origin[3] = {O.x, O.y, O.z};
  simd::find_offsets(origin, planes().scale(), chunk);
  if (projection().kind() == ProjectionKind::Plane) {
    simd::find_texels(plane_map_of(*this, projection()), chunk);
  } else {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto texel = texel_of({chunk.offset_x[i], chunk.offset_y[i], chunk.offset_z[i]});
      chunk.texel[i] = texel ? texel->y * width() + texel->x : -1;
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (chunk.texel[i] >= 0) texels().prefetch(static_cast<std::size_t>(chunk.texel[i]));
  }

  const std::uint32_t* ids[simd::kChunk];
  std::uint32_t counts[simd::kChunk];
  simd::ListPoint asked[simd::kChunk];
  std::uint8_t numbers[simd::kChunk];
  std::size_t asked_count = 0, by_float = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    lit[i] = 1;
    if (chunk.texel[i] < 0) continue;
    const auto texel = static_cast<std::size_t>(chunk.texel[i]);
    if (!(chunk.length[i] < simd::kLargestOffset)) {
      lit[i] = get_lighten_up(points[i], counters);
    } else if (is_beyond(chunk.length[i], texels().cut(texel))) {
      lit[i] = 0;
      ++by_float;
    } else if (const std::span<const std::uint32_t> faces = texels().faces_at(texel); !faces.empty()) {
      __builtin_prefetch(faces.data());
      ids[asked_count] = faces.data();
      counts[asked_count] = static_cast<std::uint32_t>(faces.size());
      asked[asked_count] = list_point({chunk.D_x[i], chunk.D_y[i], chunk.D_z[i]}, chunk.length[i]);
      numbers[asked_count++] = static_cast<std::uint8_t>(i);
    }
  }
  simd::Verdict verdicts[simd::kChunk];
  by_float += simd::find_blockers(planes().planes(), ids, counts, asked, asked_count, verdicts);
  for (std::size_t k = 0; k < asked_count; ++k) {
    const std::size_t i = numbers[k];
    lit[i] = verdicts[k] == simd::kUndecided ? get_lighten_up(points[i], counters) : verdicts[k] == simd::kNo;
  }
  for (std::size_t i = 0; has_cut_outs() && i < points.size(); ++i) {
    if (lit[i] == 0 || chunk.texel[i] < 0) continue;
    const bool is_alone = cut_texels().faces_at(static_cast<std::size_t>(chunk.texel[i])).empty();
    if (!is_alone) lit[i] = get_lighten_up(points[i], counters);
  }
  if (counters != nullptr) counters->by_float += by_float;
}

bool PointLight::is_blocked(const SurfacePoint& point, Counters* counters) const {
  const FloatingPointMode mode;
  const TruePoint p{point.origin, point.direction, point.vertices, point.side};
  const DVector offset = offset_from(position(), p, ray_parameter(p));
  if (offset == DVector(0)) return false;
  const std::uint32_t skip = point.face == kNoFace ? kSkipNone : static_cast<std::uint32_t>(point.face);
  return is_blocked(offset, p, skip, 0, counters) ||
         is_blocked_by_cut_outs(offset, p, seen_point(point), skip, counters);
}

bool PointLight::get_lighten_up(const SurfacePoint& point, Counters* counters) const {
  const FloatingPointMode mode;
  if (point.face != kNoFace && (point.face < 0 || static_cast<std::size_t>(point.face) >= scene().face_count())) {
    throw Error("the face of a surface point is not one of the scene");
  }
  const int own_side = point.face == kNoFace ? facemap::side(point.vertices, position()) : side(point.face);
  return own_side * point.side > 0 && !is_blocked(point, counters);
}

bool PointLight::get_lighten_up(const Vector& point, const On& on, Counters* counters) const {
  const FloatingPointMode mode;
  if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) {
    throw Error(kNotFinite);
  }
  if (!(on.tolerance >= 0) || !std::isfinite(on.tolerance) || (on.tolerance > 0 && on.face != kNoFace)) {
    throw Error("a point to be lit takes a face or a finite tolerance that is not negative, not both");
  }
  GivenPoint given{point};
  given.tolerance = on.tolerance;
  Triangle own;
  std::uint32_t skip = kSkipNone;
  if (on.face != kNoFace) {
    if (on.face < 0 || static_cast<std::size_t>(on.face) >= scene().face_count() ||
        !all_faces().is_kept(static_cast<std::size_t>(on.face))) {
      throw Error("the face that a point lies on is not one of the scene's kept faces");
    }
    skip = static_cast<std::uint32_t>(on.face);
    own = triangle_of(scene(), skip);
    given.on_face = &own;
  }
  const DVector offset = offset_from(position(), given);
  if (offset == DVector(0)) return true;
  return !is_blocked(offset, given, skip, on.tolerance, counters) &&
         !is_blocked_by_cut_outs(offset, given, DVector(point), skip, counters);
}

}  // namespace facemap
