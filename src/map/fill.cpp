#include "map/fill.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "map/edge_curve.h"
#include "map/face_planes.h"
#include "math/clip.h"
#include "math/dvector.h"
#include "math/elementary.h"
#include "math/exact_sign.h"

namespace facemap {
namespace {

using LocalTriangle = std::array<DVector, 3>;

// Plane projection: what is nearer to the camera's plane than this share of the face's farthest coordinate is
// dropped. Far below a float32 vertex's own grain (2^-24), far above where map points overflow.
constexpr double kNearestShare = 0x1p-40;

// Sine (no unit) of the angle within which an edge counts as running through the antipode. The turn that takes it
// away, 4 times as much, is below 2^-15 texel on the largest map (2^15 texels for 2 pi radians), and leaves an angle
// that the bisection of an edge resolves.
constexpr double kAntipodeSine = 0x1p-30;

// ---- the antipode ---------------------------------------------------------------------------------------

enum class Antipode { Outside, Inside, OnEdge };

// Where the direction (0, 0, -1) meets the face. `s` is the sign of det(a, b, c) in local axes.
Antipode classify_antipode(const LocalTriangle& face, int s) {
  bool on_edge = false;
  for (int i = 0; i < 3; ++i) {
    const DVector n = cross(face[i], face[(i + 1) % 3] - face[i]);
    const double sine = -s * n.z / length(n);
    if (sine < -kAntipodeSine) return Antipode::Outside;
    on_edge = on_edge || sine <= kAntipodeSine;
  }
  return on_edge ? Antipode::OnEdge : Antipode::Inside;
}

// First-order rotation: moves the antipode's direction by (x, y) radians.
DVector turned(const DVector& p, double x, double y) { return {p.x + x * p.z, p.y + y * p.z, p.z - x * p.x - y * p.y}; }

// Turns a face that touches the antipode with an edge or a vertex until it does not. A turn fails only for an edge
// along itself: two edges that meet at the antipode fail two turns at most.
Antipode turn_off_antipode(LocalTriangle& face, int s) {
  constexpr std::array<std::array<double, 2>, 3> kTurns = {{{3.1, 1.3}, {-1.7, 2.9}, {-2.3, -3.7}}};
  const LocalTriangle original = face;
  Antipode where = classify_antipode(face, s);
  for (const auto& [x, y] : kTurns) {
    if (where != Antipode::OnEdge) break;
    for (int i = 0; i < 3; ++i) face[i] = turned(original[i], x * kAntipodeSine, y * kAntipodeSine);
    where = classify_antipode(face, s);
  }
  return where;
}

// ---- rows of the map ------------------------------------------------------------------------------------

struct Crossing {
  int row;
  double x;

  friend bool operator<(const Crossing& a, const Crossing& b) { return a.row < b.row || (a.row == b.row && a.x < b.x); }
};

// First index i >= 0 whose pixel centre i + 0.5 is at or after `edge`, at most `size`.
int first_centre(double edge, int size) {
  return static_cast<int>(std::ceil(std::clamp(edge - 0.5, 0.0, static_cast<double>(size))));
}

// Wang 2022, Alg. 4: where the closed curve crosses the centre line of each row. Each end of a piece counts as above
// or below, never as on the line, so a closed curve crosses every row an even number of times.
// Departs: Alg. 4 takes the x of the point that is on the line; ours interpolates between the two.
void append_crossings(const std::vector<MapPoint>& curve, int height, std::vector<Crossing>& crossings) {
  for (std::size_t i = 0; i < curve.size(); ++i) {
    MapPoint a = curve[i], b = curve[i + 1 == curve.size() ? 0 : i + 1];
    if (a.y > b.y) std::swap(a, b);
    const int end = first_centre(b.y, height);
    for (int row = first_centre(a.y, height); row < end; ++row) {
      crossings.push_back({row, a.x + (b.x - a.x) * ((row + 0.5 - a.y) / (b.y - a.y))});
    }
  }
}

// The rim: the circle of all directions 180 degrees from the sight.
void append_rim_crossings(const Projection& projection, std::vector<Crossing>& crossings) {
  const double radius = elementary::kPi / projection.texel_angle();
  for (int row = 0; row < projection.height(); ++row) {
    const double dy = row + 0.5 - projection.height() * 0.5;
    if (!(std::fabs(dy) < radius)) continue;
    const double dx = std::sqrt(radius * radius - dy * dy);
    crossings.push_back({row, projection.width() * 0.5 - dx});
    crossings.push_back({row, projection.width() * 0.5 + dx});
  }
}

// ---- one face after the other ---------------------------------------------------------------------------

class Filler {
 public:
  explicit Filler(const Projection& projection) : projection_(projection) {}

  // The texels of the face, ascending; valid until the next call.
  const std::vector<std::uint32_t>& fill(LocalTriangle face, int s) {
    texels_.clear();
    if (projection_.kind() == ProjectionKind::Plane) {
      fill_polygon(in_front(face), false);
    } else {
      const bool around_antipode = turn_off_antipode(face, s) == Antipode::Inside;
      fill_polygon({face.begin(), face.end()}, around_antipode);
    }
    std::sort(texels_.begin(), texels_.end());
    texels_.erase(std::unique(texels_.begin(), texels_.end()), texels_.end());
    return texels_;
  }

 private:
  std::span<const DVector> in_front(const LocalTriangle& face) {
    double largest = 0;
    for (const DVector& p : face) largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    clip_at_near_plane(face, kNearestShare * largest, clipped_);
    return clipped_;
  }

  void fill_polygon(std::span<const DVector> polygon, bool around_antipode) {
    plot_curve(polygon);
    crossings_.clear();
    append_crossings(curve_, projection_.height(), crossings_);
    if (around_antipode) append_rim_crossings(projection_, crossings_);
    fill_rows();
    add_curve_texels();
  }

  void plot_curve(std::span<const DVector> polygon) {
    corners_.clear();
    for (const DVector& p : polygon) corners_.push_back({p, projection_.map_from_local(p)});
    curve_.clear();
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      append_edge_curve(corners_[i], corners_[(i + 1) % corners_.size()], projection_, curve_);
    }
  }

  // Wang 2022, Alg. 3: from each odd crossing of a row to the next even one.
  void fill_rows() {
    std::sort(crossings_.begin(), crossings_.end());
    for (std::size_t i = 0; i + 1 < crossings_.size(); i += 2) {
      const int begin = first_centre(crossings_[i].x, projection_.width());
      const int end = first_centre(crossings_[i + 1].x, projection_.width());
      for (int column = begin; column < end; ++column) add(column, crossings_[i].row);
    }
  }

  // The curve's points are pixels of the shape, as in sec. 2.3 ("its three edges and inside pixels"): a face between
  // all texel centres is not lost.
  void add_curve_texels() {
    for (const MapPoint& p : curve_) {
      if (p.x >= 0 && p.x < projection_.width() && p.y >= 0 && p.y < projection_.height()) {
        add(static_cast<int>(p.x), static_cast<int>(p.y));
      }
    }
  }

  void add(int column, int row) {
    texels_.push_back(static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(projection_.width()) +
                      static_cast<std::uint32_t>(column));
  }

  const Projection& projection_;
  std::vector<DVector> clipped_;
  std::vector<CurvePoint> corners_;
  std::vector<MapPoint> curve_;
  std::vector<Crossing> crossings_;
  std::vector<std::uint32_t> texels_;
};

}  // namespace

void fill_faces(const Scene& scene, const SpaceVector& frame, const Projection& projection,
                std::vector<TexelEntry>& entries) {
  const DVector origin(frame.position());
  Filler filler(projection);
  for (const std::uint32_t face : scene.kept_faces()) {
    const Triangle world = triangle_of(scene, face);
    const int s = -side(world, frame.position());  // local axes are left-handed: the sign turns
    if (s == 0) continue;
    LocalTriangle local;
    for (int i = 0; i < 3; ++i) local[i] = frame.local_from_world(DVector(world[i]) - origin);
    for (const std::uint32_t texel : filler.fill(local, s)) entries.push_back({texel, face});
  }
}

}  // namespace facemap
