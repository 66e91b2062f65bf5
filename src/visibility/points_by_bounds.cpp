#include "visibility/points_by_bounds.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "picture/bytes_of.h"
#include "picture/near_face.h"
#include "picture/point_projection.h"
#include "visibility/points_by_faces.h"
#include "visibility/target_points.h"

namespace facemap {
namespace {

// A task's points: few enough that what is made of them stays near.
constexpr std::size_t kPiece = std::size_t{1} << 14;

// Who is told of what is asked again.
const Viewpoint::Progress kNobody;

// Whether some point near to where this one is held to be is behind some face: not if it is surely off the raster,
// which holds all faces, or behind the plane of the origin, which they are all in front of.
class Behind {
 public:
  Behind(const LightBounds& bounds, const AskedPoints& points, const Vector& origin)
      : frame_(bounds.frame()),
        points_(points),
        from_origin_(points.origin - DVector(origin)),
        error_(PointProjection(points, origin, size_of_offsets(points, origin)).error_in(frame_)) {}

  bool may_be(std::uint32_t point) const {
    const DVector offset = from_origin_ + points_.step * DVector(points_.x[point], points_.y[point], points_.z[point]);
    double place[3] = {};
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) place[i] += frame_.rows[i][k] * offset[k];
    }
    const double reach = (place[2] + error_) * (1 + 0x1p-40) + error_;
    return place[2] > -error_ && std::max(std::fabs(place[0]), std::fabs(place[1])) <= reach;
  }

 private:
  simd::ShadowFrame frame_;
  const AskedPoints& points_;
  DVector from_origin_;
  double error_;
};

// Bounds say what is behind a patch of faces by more than twice this, relative (simd::kShadowDepthFactor).
constexpr double kSurelyBehind = 0x1p-17;

// Whether a point may be in the dark for no other reason than a patch with its own face, which does not count. Such a
// patch leaves points that are hardly behind the face alone.
bool may_be_dark_by_own(const PointQuestion& question, const AskedPoints& points, std::uint32_t point) {
  const std::uint32_t own = points.faces[point];
  if (own == kNoOwnFace || !question.faces.is_kept(own)) return false;
  const Triangle corners = triangle_of(question.faces, own);
  const int own_side = side(corners, question.origin);
  if (own_side == 0) return false;
  const DVector D = place_of(points, point) - DVector(question.origin);
  const NearFace face = near_face(own, own_side, corners, question.origin);
  return verdict_on(face, (1 - kSurelyBehind) * D, error_of(points, point)) >= 0;
}

// Those of a piece's dark points that it may concern are left to all faces. The piece begins with target `first`.
void find_dark_by_own(const PointQuestion& question, std::size_t first, const AskedPoints& points,
                      const UnsetVector<std::uint8_t>& dark, std::vector<std::size_t>& left) {
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (dark[i] != 0 && may_be_dark_by_own(question, points, i)) left.push_back(first + i);
  }
}

// Targets that bounds and lists leave open.
class Rest {
 public:
  void add(std::vector<std::size_t>&& targets) {
    if (targets.empty()) return;
    const std::scoped_lock lock(adding_);
    targets_.insert(targets_.end(), targets.begin(), targets.end());
  }

  // All faces.
  void ask(const PointQuestion& question, const Executor& executor, Spares<ShadowScratch>& spares) {
    if (targets_.empty()) return;
    std::sort(targets_.begin(), targets_.end());
    std::vector<Vector> places;
    std::vector<FaceId> faces;
    for (const std::size_t target : targets_) {
      places.push_back(question.targets.points[target]);
      if (!question.targets.faces.empty()) faces.push_back(question.targets.faces[target]);
    }
    std::vector<std::uint8_t> visible(places.size());
    const Viewpoint::Targets targets{places, faces};
    ToldProgress told(kNobody, places.size());
    ask_faces({question.faces, question.origin, targets, visible}, executor, spares, told);
    for (std::size_t k = 0; k < places.size(); ++k) question.visible[targets_[k]] = visible[k];
  }

 private:
  std::mutex adding_;
  std::vector<std::size_t> targets_;
};

}  // namespace

std::size_t BoundsScratch::memory_bytes() const noexcept {
  return sizeof(*this) + bytes_of(points.x) + bytes_of(points.y) + bytes_of(points.z) + bytes_of(points.faces) +
         decided.memory_bytes();
}

void ask_bounds(const LightBounds& bounds, const PointQuestion& question, const Executor& executor,
                Spares<BoundsScratch>& spares, Spares<ShadowScratch>& spares_for_rest, ToldProgress& told) {
  Rest rest;
  executor.for_each((question.size() + kPiece - 1) / kPiece, [&](std::size_t piece, int) {
    const std::size_t first = piece * kPiece, last = std::min(first + kPiece, question.size());
    const Spares<BoundsScratch>::Loan scratch(spares);
    AskedPoints& points = scratch->points;
    DecidedPoints& decided = scratch->decided;
    put_points(question.faces, question.targets, first, last, points);
    std::uint8_t* const visible = question.visible.data() + first;
    std::fill_n(visible, last - first, std::uint8_t{1});
    const MaskBit mask{visible, visible, 1, 0};
    const bool has_lists = can_ask_lists(question.faces, question.origin, size_of_offsets(points, question.origin));
    Counters counters;
    decide_points(bounds, question.origin, points, mask, decided, counters, has_lists);
    std::vector<std::size_t> left;
    if (!question.targets.faces.empty()) find_dark_by_own(question, first, points, decided.dark, left);
    if (has_lists) {
      const auto hides = [&](std::size_t point, std::uint32_t face, int side) {
        return question.hides(face, side, first + point);
      };
      ask_lists(question.faces, question.origin, *bounds.lists(), points, mask, hides, decided.listed, decided.dark,
                counters);
    }
    const Behind behind(bounds, points, question.origin);
    for (const std::uint32_t point : decided.numbers) {
      if (behind.may_be(point)) left.push_back(first + point);
    }
    rest.add(std::move(left));
    told.add(last - first);
  });
  rest.ask(question, executor, spares_for_rest);
}

}  // namespace facemap
