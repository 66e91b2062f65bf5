#include "map/cover.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "map/cone.h"
#include "map/plane_cover.h"
#include "map/texel_box.h"
#include "map/texels.h"
#include "math/dvector.h"
#include "math/elementary.h"

namespace facemap {
namespace {

constexpr double kHalfDiagonal = 0.70710678118654757;  // of a unit square, rounded up

// Faces within this angle of the axis get a box of texels; the bulge and the map's scale grow without bound
// towards the antipode (180 degrees).
constexpr double kLargestBoxAngle = 2.6;

// Longer edges than this (radians) are left to the blocks: their boxes would be mostly bulge.
constexpr double kLongestBoxEdge = 0.5;

// Room that is made beforehand, entries a face.
constexpr std::size_t kEntriesExpected = 8;

// Projection::local_from_map of texel centres on a surface, where a direction's sine and cosine depend on the distance
// from the raster's centre alone: each is made once, with the same bits.
class CentreDirections {
 public:
  explicit CentreDirections(const Projection& projection) : projection_(projection) {
    const auto width = static_cast<std::size_t>(projection.width()),
               height = static_cast<std::size_t>(projection.height());
    const bool is_even = width % 2 == 0 && height % 2 == 0;
    shift_ = is_even ? 3 : 2;
    const std::size_t count = ((width * width + height * height) >> shift_) + 1;
    if (projection.kind() == ProjectionKind::Surface && count <= width * height) by_distance_.resize(count);
  }

  DVector at(int x, int y) {
    const MapPoint centre(x + 0.5, y + 0.5);
    if (by_distance_.empty()) return projection_.local_from_map(centre);
    // Twice the distance from the centre, squared. Odd numbers squared are 1 modulo 8, even ones 0 modulo 4.
    const std::int64_t dx = 2 * x + 1 - projection_.width(), dy = projection_.height() - 2 * y - 1;
    Polar& polar = by_distance_[static_cast<std::size_t>(dx * dx + dy * dy) >> shift_];
    const double across = 0.5 * static_cast<double>(dx), up = 0.5 * static_cast<double>(dy);
    if (!polar.is_known) polar = polar_of(std::sqrt(across * across + up * up));
    return {polar.sine_over_r * across, polar.sine_over_r * up, polar.cosine};
  }

 private:
  struct Polar {
    double sine_over_r = 0, cosine = 0;
    bool is_known = false;
  };

  Polar polar_of(double r) const {
    const double beta = r * projection_.texel_angle();
    return {r == 0 ? 0 : elementary::sin(beta) / r, elementary::cos(beta), true};
  }

  const Projection& projection_;
  int shift_;
  std::vector<Polar> by_distance_;
};

class ConeCover {
 public:
  ConeCover(const Scene& scene, const SpaceVector& frame, const Projection& projection, const FacePlanesTable& planes,
            Coverage& out)
      : scene_(scene), frame_(frame), projection_(projection), planes_(planes), out_(out), centres_(projection) {
    while (root_size_ < std::max(projection.width(), projection.height())) root_size_ *= 2;
    for (int size = 1; size <= root_size_; size *= 2) radii_.emplace_back(block_cap_radius(projection, size));
    raster_ = {0, 0, projection.width() - 1, projection.height() - 1};
  }

  void add(std::uint32_t id, Pass pass) {
    pass_ = pass;
    const Cone cone(triangle_of(scene_, id), planes_.side(id), frame_);
    const std::optional<TexelBox> box = box_of(cone);
    const TexelBox region = box ? box->clipped(projection_) : raster_;
    if (region.is_empty()) return;
    if (region.x0 == region.x1 && region.y0 == region.y1) {
      visit_texel(id, cone, region.x0, region.y0);
    } else if (region.x1 - region.x0 < kSmallBox && region.y1 - region.y0 < kSmallBox) {
      for (int y = region.y0; y <= region.y1; ++y) {
        for (int x = region.x0; x <= region.x1; ++x) visit_texel(id, cone, x, y);
      }
    } else {
      descend(id, cone, region, 0, 0, root_size_, static_cast<int>(radii_.size()) - 1);
    }
  }

 private:
  // Boxes up to this many texels a side are walked texel by texel; larger ones by blocks.
  static constexpr int kSmallBox = 6;

  std::uint32_t texel_number(int x, int y) const {
    return static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(projection_.width()) +
           static_cast<std::uint32_t>(x);
  }

  // The box of the projected corners, grown by the bulge of the edges and by the map's error. None on a plane: faces
  // that have one there are PlaneFaces.
  std::optional<TexelBox> box_of(const Cone& cone) const {
    if (projection_.kind() == ProjectionKind::Plane) return std::nullopt;
    double farthest_beta = 0;
    for (int i = 0; i < 3; ++i) {
      const DVector& c = cone.corner(i);
      farthest_beta = std::max(farthest_beta, elementary::atan2(std::sqrt(c.x * c.x + c.y * c.y), c.z));
    }
    const double beta = farthest_beta + cone.longest_angle();
    if (beta > kLargestBoxAngle || cone.longest_angle() > kLongestBoxEdge) return std::nullopt;
    // Near beta the map stretches angles across the radius by beta / sin(beta).
    const double stretch = beta > 0.01 ? beta / elementary::sin(beta) : 1.01;
    const double angular_error = kDirectionError + 2 * Projection::kMapError;
    const double margin =
        (bulge(cone.longest_angle(), beta) + angular_error * stretch) / projection_.texel_angle() + kCoordinateRounding;
    const MapPoint corners[] = {projection_.map_from_local(cone.corner(0)), projection_.map_from_local(cone.corner(1)),
                                projection_.map_from_local(cone.corner(2))};
    return box_around(corners, margin);
  }

  // Quadtree of blocks, the root at (0, 0): a block goes on while the face may meet its cap.
  void descend(std::uint32_t id, const Cone& cone, const TexelBox& region, int x, int y, int size, int level) {
    if (x > region.x1 || y > region.y1 || x + size <= region.x0 || y + size <= region.y0) return;
    if (size == 1) {
      visit_texel(id, cone, x, y);
      return;
    }
    const Cone::Radius& radius = radii_[static_cast<std::size_t>(level)];
    if (radius.is_small && !cone.may_meet(direction(x + size * 0.5, y + size * 0.5), radius)) return;
    const int half = size / 2;
    for (const auto& [dx, dy] : {std::pair{0, 0}, {half, 0}, {0, half}, {half, half}}) {
      descend(id, cone, region, x + dx, y + dy, half, level - 1);
    }
  }

  void visit_texel(std::uint32_t id, const Cone& cone, int x, int y) {
    const MapPoint centre(x + 0.5, y + 0.5);
    if (is_beyond_antipode(centre)) return;
    const std::uint32_t texel = texel_number(x, y);
    const bool keeps_all = out_.cuts.empty();
    const float nearest = planes_.nearest(id);
    if (!keeps_all && Texels::is_hidden(nearest, out_.cuts[texel])) return;
    const DVector c = centres_.at(x, y);
    if (!cone.may_meet(c, radii_[0])) return;
    if (pass_ != Pass::Cuts) out_.entries.push_back({texel, id, nearest});
    if (pass_ != Pass::Entries && !keeps_all && cone.surely_covers(c, radii_[0])) {
      out_.cuts[texel] = std::min(out_.cuts[texel], float_above(cone.farthest(c, radii_[0]) * planes_.scale()));
    }
  }

  // Whether all of the texel lies more than 180 degrees from the axis, where no direction has its map point.
  bool is_beyond_antipode(const MapPoint& centre) const {
    if (projection_.kind() != ProjectionKind::Surface) return false;
    const double dx = centre.x - projection_.width() * 0.5, dy = centre.y - projection_.height() * 0.5;
    return (std::sqrt(dx * dx + dy * dy) - 1) * projection_.texel_angle() > elementary::kPi + Projection::kMapError;
  }

  DVector direction(double map_x, double map_y) const { return projection_.local_from_map({map_x, map_y}); }

  const Scene& scene_;
  const SpaceVector& frame_;
  const Projection& projection_;
  const FacePlanesTable& planes_;
  Coverage& out_;
  CentreDirections centres_;
  int root_size_ = 1;
  std::vector<Cone::Radius> radii_;  // by level: blocks of 1, 2, 4, ... texels
  TexelBox raster_;
  Pass pass_ = Pass::Both;
};

}  // namespace

double block_cap_radius(const Projection& projection, double side_texels) {
  const double reach = side_texels * kHalfDiagonal + kCoordinateRounding;
  return projection.texel_angle() * reach * (1 + 0x1p-40) + kDirectionError + 2 * Projection::kMapError;
}

// The image x(s) of a great circle run through at unit speed has |x''|^2 = A^2 u^2 + 4 T^2 u (1 - u), where u is
// the squared sine of its angle with the radius, A = beta / sin^2 beta - cot beta and T = (1 - beta cot beta) /
// sin beta. A chord of an arc of length alpha is at most max |x''| alpha^2 / 8 from it. Over u the maximum is A^2
// at u = 1 while A^2 >= 2 T^2 (up to about 107 degrees), 4 T^4 / (4 T^2 - A^2) beyond; both grow with beta.
double bulge(double angle, double beta) {
  double curvature;
  if (beta < 0.1) {
    curvature = 0.68 * beta;  // A = 2/3 beta + 4/45 beta^3 + ..., whose formula cancels near the axis
  } else {
    const double sine = elementary::sin(beta), cotangent = elementary::cos(beta) / sine;
    const double A = beta / (sine * sine) - cotangent, T = (1 - beta * cotangent) / sine;
    curvature = A * A >= 2 * T * T ? A : 2 * T * T / std::sqrt(4 * T * T - A * A);
  }
  return curvature * (1 + 0x1p-30) * angle * angle / 8;
}

Coverage cover_faces(const Scene& scene, const SpaceVector& frame, const Projection& projection,
                     const FacePlanesTable& planes, bool keep_all) {
  Coverage coverage;
  if (!keep_all) {
    const auto texel_count =
        static_cast<std::size_t>(projection.width()) * static_cast<std::size_t>(projection.height());
    coverage.cuts.assign(texel_count, std::numeric_limits<float>::infinity());
  }
  ConeCover cones(scene, frame, projection, planes, coverage);
  if (projection.kind() == ProjectionKind::Surface) {
    for (const std::uint32_t id : planes.front_to_back(scene)) cones.add(id, Pass::Both);
    return coverage;
  }
  PlaneCover plane(scene, frame, projection, planes, coverage);
  coverage.entries.reserve(kEntriesExpected * plane.count_faces());
  for (const Pass pass : {Pass::Cuts, Pass::Entries}) {
    if (pass == Pass::Cuts && keep_all) continue;
    for (const std::uint32_t id : scene.kept_faces()) {
      if (planes.side(id) != 0 && !plane.add(id, pass)) cones.add(id, pass);
    }
  }
  return coverage;
}

}  // namespace facemap
