#include "picture/nearest_lens.h"

#include <algorithm>
#include <memory>

#include "map/face_planes.h"
#include "math/exact_sign.h"
#include "picture/lens_plane.h"
#include "picture/lens_tiles.h"
#include "picture/nearest_view.h"
#include "scene/reserve_pages.h"

namespace facemap {
namespace {

constexpr std::size_t kLeastFaces = 1 << 12;  // of a task
constexpr std::size_t kLeastVertices = 1 << 14;

// Smaller faces (radians about their middle) are held against caps by a cap of their own alone; a larger one by the
// planes of its edges too, so that long ones reach few tiles.
constexpr double kSmallFace = 0.05;

// A vertex's direction of float32 is off by less: three roundings of 2^-24.
constexpr double kDirectionError = 0x1p-22;

// Where a face may lie: within its cap, and where all edges' values are at least -slack.
struct FaceCone {
  DirectionCap cap;
  DVector edges[3] = {DVector(0), DVector(0), DVector(0)};  // unit, inwards, or zero
  double slack[3] = {1, 1, 1};
  bool has_edges = false;

  bool may_meet(const DirectionCap& other) const {
    const DVector chord = other.centre - cap.centre;
    const double reach = cap.radius + other.radius;  // a chord is shorter than its angle
    if (dot(chord, chord) > reach * reach * (1 + 0x1p-40)) return false;
    for (int i = 0; i < 3 && has_edges; ++i) {
      if (dot(edges[i], other.centre) < -(other.sine + slack[i])) return false;
    }
    return true;
  }
};

struct DealtFace {
  std::uint32_t tile, face;
};

class LensRaster {
 public:
  LensRaster(const Scene& scene, const SampleGrid& grid, const Executor& executor)
      : scene_(scene), grid_(grid), executor_(executor), tiles_(grid, executor) {
    const Mesh& mesh = scene.mesh();
    source_ = {mesh.triangles.data()->data(), &mesh.positions.data()->x};
    const DVector camera(grid.frame.position());
    unit_ = unit_for(length(scene.centre() - camera) + scene.bounding_radius());
    set_axes({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1, unit_, directions_);
    for (int i = 0; i < 3; ++i) directions_.origin[i] = camera[i];
    set_errors(1, 1, 0, directions_);
  }

  NearestFaces run(Counters* counters) {
    find_directions();
    deal_all();
    sort_by_tile();
    return draw(counters);
  }

 private:
  // Of all vertices, float32; zero for one at the camera, and for what is too far to tell.
  void find_directions() {
    const auto& positions = scene_.mesh().positions;
    const DVector camera(grid_.frame.position());
    to_vertices_.resize(positions.size());
    for_ranges(executor_, positions.size(), kLeastVertices, [&](std::size_t first, std::size_t last, int) {
      for (std::size_t i = first; i < last; ++i) to_vertices_[i] = Vector(normalized(DVector(positions[i]) - camera));
    });
  }

  void deal_all() {
    const std::size_t pieces = executor_.threads() == 1 ? 1 : std::size_t{4} * executor_.threads();
    const std::size_t count = scene_.face_count(), least = std::max(kLeastFaces, count / pieces + 1);
    dealt_.resize((count + least - 1) / least);
    executor_.for_each(dealt_.size(), [&](std::size_t i, int) {
      const std::size_t end = std::min(count, (i + 1) * least);
      for (std::size_t face = i * least; face < end; ++face) {
        if (scene_.is_kept(static_cast<std::uint32_t>(face))) deal(static_cast<std::uint32_t>(face), dealt_[i]);
      }
    });
  }

  void deal(std::uint32_t face, std::vector<DealtFace>& out) const {
    FaceCone cone;
    set_cap(face, cone);
    if (cone.cap.radius > kSmallFace && !set_edges(face, cone)) return;
    tiles_.descend([&](const DirectionCap& cap) { return cone.may_meet(cap); },
                   [&](std::uint32_t tile) {
                     out.push_back({tile, face});
                   });
  }

  // Caps below 90 degrees are convex: one that holds the corners holds the face.
  void set_cap(std::uint32_t face, FaceCone& cone) const {
    const Corners& corners = scene_.mesh().triangles[face];
    DVector sum(0);
    for (const std::uint32_t corner : corners) sum += DVector(to_vertices_[corner]);
    if (!(dot(sum, sum) > 1)) return;  // of no use; a corner at the camera leaves the sum of two
    const DVector centre = normalized(sum);
    double squared = 0;
    for (const std::uint32_t corner : corners) {
      const DVector chord = DVector(to_vertices_[corner]) - centre;
      squared = std::max(squared, dot(chord, chord));
    }
    const double radius = angle_of_chord(std::sqrt(squared) + kDirectionError);
    if (radius < elementary::kPi) cone.cap = {centre, radius};
  }

  // False if the face is seen exactly edge-on.
  bool set_edges(std::uint32_t id, FaceCone& cone) const {
    simd::LargeFace face;
    simd::set_up_large(source_, directions_, &id, 1, nullptr, &face);
    if (face.is_unsure) {
      const auto s = static_cast<std::int8_t>(side(triangle_of(scene_, id), grid_.frame.position()));
      if (s == 0) return false;
      simd::set_up_large(source_, directions_, &id, 1, &s, &face);
    }
    cone.has_edges = true;
    for (int k = 0; k < 3; ++k) {
      const DVector edge(face.A[k], face.B[k], face.C[k]);
      const double size = length(edge);
      if (!(size > 1)) continue;  // tells nothing
      cone.edges[k] = edge * (1 / size);
      cone.slack[k] = 1 / size + DirectionCap::kSlack;  // a value of -1 may still be inside
    }
    return true;
  }

  // Counting sort, faces of a tile in the order of their numbers.
  void sort_by_tile() {
    starts_.assign(tiles_.tiles().size() + 1, 0);
    for (const auto& dealt : dealt_) {
      for (const DealtFace& d : dealt) ++starts_[d.tile + 1];
    }
    for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    faces_ = std::make_unique_for_overwrite<std::uint32_t[]>(starts_.back());
    std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
    for (auto& dealt : dealt_) {
      for (const DealtFace& d : dealt) faces_[next[d.tile]++] = d.face;
      dealt = {};
    }
  }

  struct Work {
    TileRaster raster;
    std::vector<TileFace> faces;
    std::vector<std::uint32_t> loose;
    Counters counters;

    Work(const Scene& scene, const SampleGrid& grid, const simd::FaceSource& source)
        : raster(scene, grid, source, TilePlane::kLargestTile, kLensRowSamples) {}
  };

  NearestFaces draw(Counters* counters) {
    NearestFaces nearest;
    resize_pages(nearest.faces, grid_.count());
    std::vector<std::unique_ptr<Work>> works(static_cast<std::size_t>(executor_.threads()));
    executor_.for_each(tiles_.tiles().size(), [&](std::size_t i, int worker) {
      std::unique_ptr<Work>& work = works[static_cast<std::size_t>(worker)];
      if (!work) work = std::make_unique<Work>(scene_, grid_, source_);
      draw_tile(i, *work, nearest);
    });
    for (const std::unique_ptr<Work>& work : works) {
      if (!work) continue;
      nearest.loose.insert(nearest.loose.end(), work->loose.begin(), work->loose.end());
      if (counters != nullptr) *counters += work->counters;
    }
    std::sort(nearest.loose.begin(), nearest.loose.end());
    return nearest;
  }

  void draw_tile(std::size_t i, Work& work, NearestFaces& nearest) const {
    const LensTiles::Tile& tile = tiles_.tiles()[i];
    work.faces.clear();
    if (starts_[i] < starts_[i + 1]) {
      set_plane(grid_, tile, unit_, work.raster.plane);
      const TileBoxes boxes(tile, work.raster.plane);
      for (std::size_t k = starts_[i]; k < starts_[i + 1]; ++k) {
        TileFace face{faces_[k], 0, 0, 0, 0};
        if (boxes.find(offsets_of(faces_[k]), face)) work.faces.push_back(face);
      }
    }
    work.raster.draw(tile.area, work.faces, nearest, work.loose, work.counters);
  }

  TileBoxes::Offsets offsets_of(std::uint32_t face) const {
    const Mesh& mesh = scene_.mesh();
    const DVector camera(grid_.frame.position());
    TileBoxes::Offsets offsets;
    for (std::size_t k = 0; k < 3; ++k) offsets[k] = DVector(mesh.positions[mesh.triangles[face][k]]) - camera;
    return offsets;
  }

  const Scene& scene_;
  const SampleGrid& grid_;
  const Executor& executor_;
  LensTiles tiles_;
  simd::FaceSource source_;
  double unit_ = 1;
  simd::PlaneFrame directions_;  // of unit length, world axes
  std::vector<Vector> to_vertices_;
  std::vector<std::vector<DealtFace>> dealt_;
  std::vector<std::size_t> starts_;
  std::unique_ptr<std::uint32_t[]> faces_;
};

}  // namespace

NearestFaces draw_lens_view(const Scene& scene, const SampleGrid& grid, const Executor& executor, Counters* counters) {
  if (grid.directions) return LensRaster(scene, grid, executor).run(counters);
  SampleGrid filled = grid;
  filled.directions = make_directions(grid, executor);
  return LensRaster(scene, filled, executor).run(counters);
}

}  // namespace facemap
