#include "picture/nearest_tiles.h"

#include <algorithm>
#include <memory>
#include <span>

#include "map/face_planes.h"
#include "math/exact_sign.h"
#include "picture/nearest_queues.h"
#include "picture/nearest_surface.h"
#include "picture/pages.h"
#include "picture/tile_raster.h"
#include "scene/reserve_pages.h"

namespace facemap {
namespace {

constexpr std::size_t kChunk = 4096;             // faces whose boxes are found at a time
constexpr std::size_t kLeastVertices = 1 << 14;  // of a task
constexpr std::size_t kLeastFaces = 1 << 14;

// Boxes over more tiles than this are held against the tiles' caps, so that long or bent faces reach few of them.
constexpr int kFewTiles = 4;

struct DealtFace {
  std::uint32_t tile;
  TileFace face;
};

class SurfaceRaster {
 public:
  SurfaceRaster(const Scene& scene, const SampleGrid& grid, const Executor& executor)
      : scene_(scene),
        grid_(grid),
        executor_(executor),
        view_(scene, grid),
        caps_(view_, grid),
        rays_(grid),
        points_(2 * (scene.mesh().positions.size() + simd::kVertexRoom)) {
    const Mesh& mesh = scene.mesh();
    source_ = {mesh.triangles.data()->data(), &mesh.positions.data()->x};
  }

  NearestFaces run(Counters* counters) {
    for_ranges(executor_, scene_.mesh().positions.size(), kLeastVertices,
               [&](std::size_t first, std::size_t last, int) {
                 simd::project_vertices_surface(source_.positions + 3 * first, last - first, view_.vertices,
                                                points_.data() + 2 * first);
               });
    deal_all();
    sort_by_tile();
    return draw(counters);
  }

 private:
  std::size_t tile_count() const { return starts_.size() - 1; }

  void deal_all() {
    const std::size_t pieces = executor_.threads() == 1 ? 1 : std::size_t{4} * executor_.threads();
    const std::size_t count = scene_.face_count(), least = std::max(kLeastFaces, count / pieces + 1);
    dealt_.resize((count + least - 1) / least);
    executor_.for_each(dealt_.size(), [&](std::size_t i, int) {
      BoxQueues queues(kChunk);
      std::vector<std::uint32_t> tiles(caps_.caps().count + simd::kBlockFaces);
      const std::size_t end = std::min(count, (i + 1) * least);
      for (std::size_t first = i * least; first < end; first += kChunk) {
        simd::find_boxes(source_.triangles, first, std::min(kChunk, end - first), points_.data(), view_.boxes,
                         queues.fresh());
        queues.drop_odd_faces(scene_);
        for (int q = 0; q < BoxQueues::kQueues; ++q) deal(queues[q], tiles, dealt_[i]);
      }
    });
  }

  void deal(const simd::BoxQueue& boxes, std::vector<std::uint32_t>& tiles, std::vector<DealtFace>& out) {
    const int side = view_.tile_side;
    for (std::size_t i = 0; i < boxes.size; ++i) {
      const simd::SampleBox box = {boxes.x0[i], boxes.x1[i], boxes.y0[i], boxes.y1[i]};
      const int x0 = box.x0 / side, x1 = box.x1 / side, y0 = box.y0 / side, y1 = box.y1 / side;
      if ((x1 - x0 + 1) * (y1 - y0 + 1) > kFewTiles) {
        deal_large(boxes.faces[i], box, tiles, out);
        continue;
      }
      for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) deal_to(x, y, boxes.faces[i], box, out);
      }
    }
  }

  // The part of the box in tile (x, y), if any.
  void deal_to(int x, int y, std::uint32_t face, const simd::SampleBox& box, std::vector<DealtFace>& out) const {
    const int side = view_.tile_side, left = x * side, top = y * side;
    const int x0 = std::max(box.x0 - left, 0), x1 = std::min(box.x1 - left, side - 1);
    const int y0 = std::max(box.y0 - top, 0), y1 = std::min(box.y1 - top, side - 1);
    if (x0 > x1 || y0 > y1) return;
    const auto byte = [](int value) { return static_cast<std::uint8_t>(value); };
    out.push_back(
        {static_cast<std::uint32_t>(y * view_.tile_columns + x), {face, byte(x0), byte(x1), byte(y0), byte(y1)}});
  }

  void deal_large(std::uint32_t id, const simd::SampleBox& box, std::vector<std::uint32_t>& tiles,
                  std::vector<DealtFace>& out) {
    simd::LargeFace face;
    simd::set_up_large(source_, view_.directions, &id, 1, nullptr, &face);
    if (face.is_unsure) {
      const auto s = static_cast<std::int8_t>(side(triangle_of(scene_, id), grid_.frame.position()));
      if (s == 0) return;
      simd::set_up_large(source_, view_.directions, &id, 1, &s, &face);
    }
    const std::size_t count = simd::find_tiles(face, caps_.caps(), tiles.data());
    for (std::size_t i = 0; i < count; ++i) {
      const int tile = static_cast<int>(tiles[i]);
      deal_to(tile % view_.tile_columns, tile / view_.tile_columns, id, box, out);
    }
  }

  // Counting sort, faces of a tile in the order in which they were dealt.
  void sort_by_tile() {
    starts_.assign(caps_.caps().count + 1, 0);
    for (const auto& dealt : dealt_) {
      for (const DealtFace& d : dealt) ++starts_[d.tile + 1];
    }
    for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    faces_ = std::make_unique_for_overwrite<TileFace[]>(starts_.back());
    std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
    for (auto& dealt : dealt_) {
      for (const DealtFace& d : dealt) faces_[next[d.tile]++] = d.face;
      dealt = {};
    }
  }

  NearestFaces draw(Counters* counters) {
    NearestFaces nearest;
    resize_pages(nearest.faces, grid_.count());
    const auto threads = static_cast<std::size_t>(executor_.threads());
    std::vector<std::unique_ptr<TileRaster>> rasters(threads);
    std::vector<Counters> counts(threads);
    std::vector<std::vector<std::uint32_t>> loose(threads);
    executor_.for_each(tile_count(), [&](std::size_t i, int worker) {
      const auto w = static_cast<std::size_t>(worker);
      if (!rasters[w]) {
        rasters[w] = std::make_unique<TileRaster>(scene_, grid_, source_, view_.tile_side, view_.row_samples);
      }
      const SurfaceTile tile = tile_of(view_, grid_, i);
      std::span<const TileFace> faces(faces_.get() + starts_[i], faces_.get() + starts_[i + 1]);
      if (tile.is_empty) faces = {};
      if (!faces.empty()) set_plane(view_, grid_, rays_, tile, rasters[w]->plane);
      rasters[w]->draw(tile, faces, nearest, loose[w], counts[w]);
    });
    for (std::size_t w = 0; w < threads; ++w) {
      nearest.loose.insert(nearest.loose.end(), loose[w].begin(), loose[w].end());
      if (counters != nullptr) *counters += counts[w];
    }
    std::sort(nearest.loose.begin(), nearest.loose.end());
    return nearest;
  }

  const Scene& scene_;
  const SampleGrid& grid_;
  const Executor& executor_;
  SurfaceView view_;
  SurfaceCaps caps_;
  RayTable rays_;
  Pages<float> points_;
  simd::FaceSource source_;
  std::vector<std::vector<DealtFace>> dealt_;
  std::vector<std::size_t> starts_;
  std::unique_ptr<TileFace[]> faces_;
};

}  // namespace

NearestFaces draw_surface_view(const Scene& scene, const SampleGrid& grid, const Executor& executor,
                               Counters* counters) {
  return SurfaceRaster(scene, grid, executor).run(counters);
}

}  // namespace facemap
