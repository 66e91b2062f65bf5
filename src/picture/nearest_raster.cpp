#include "picture/nearest_raster.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "map/face_planes.h"
#include "math/exact_sign.h"
#include "picture/block_raster.h"
#include "picture/nearest_contests.h"
#include "picture/nearest_queues.h"
#include "picture/pages.h"
#include "scene/reserve_pages.h"
#include "simd/nearest_blocks.h"
#include "simd/nearest_draw.h"

namespace facemap {
namespace {

// Faces whose boxes are found before they are drawn: their vertices are still in the cache then.
constexpr std::size_t kChunk = 4096;

// The same where they are dealt to bands of rows first: more fill the lanes better.
constexpr std::size_t kLargestDeal = 1 << 13;

// Bands of rows a thread, so that crowded ones even out.
constexpr int kBandsPerThread = 6;

constexpr std::size_t kLeastVertices = 1 << 14;  // of a task

class PlaneRaster {
 public:
  PlaneRaster(const Scene& scene, const SampleGrid& grid, const PlaneView& view, const Executor& executor)
      : scene_(scene),
        grid_(grid),
        view_(view),
        executor_(executor),
        points_(2 * (scene.mesh().positions.size() + simd::kVertexRoom)),
        samples_(grid.columns(), grid.rows()) {
    const Mesh& mesh = scene.mesh();
    source_ = {mesh.triangles.data()->data(), &mesh.positions.data()->x};
  }

  NearestFaces run(Counters* counters) {
    project();
    if (executor_.threads() == 1) {
      draw_all_at_once();
    } else {
      draw_in_bands();
    }
    finish(counters);
    nearest_.spare = samples_.release();
    return std::move(nearest_);
  }

 private:
  struct Band {
    int first_row, last_row;
    simd::Contests contests;
    std::unique_ptr<simd::Fragments> fragments = std::make_unique<simd::Fragments>();
    std::vector<std::uint32_t> loose;
    Counters counters;
    std::size_t contested = 0;

    Band(int first, int last) : first_row(first), last_row(last) {}
  };

  void project() {
    for_ranges(executor_, scene_.mesh().positions.size(), kLeastVertices,
               [&](std::size_t first, std::size_t last, int) {
                 simd::project_vertices(source_.positions + 3 * first, last - first, view_.vertices,
                                        points_.data() + 2 * first);
               });
  }

  void find_boxes(std::size_t first, std::size_t most, BoxQueues& queues) const {
    const std::size_t count = std::min(most, scene_.face_count() - first);
    simd::find_boxes(source_.triangles, first, count, points_.data(), view_.boxes, queues.fresh());
    queues.drop_odd_faces(scene_);
  }

  void draw_all_at_once() {
    bands_.emplace_back(0, grid_.rows() - 1);
    BoxQueues queues(kChunk);
    for (std::size_t first = 0; first < scene_.face_count(); first += kChunk) {
      find_boxes(first, kChunk, queues);
      for (int q = 0; q < BoxQueues::kQueues; ++q) draw(q, queues[q], bands_[0]);
    }
  }

  void draw_in_bands() {
    // Rows of blocks stay together.
    const int rows = grid_.rows(), all = (rows + simd::kBlockSide - 1) / simd::kBlockSide;
    const int count = std::min(all, kBandsPerThread * executor_.threads());
    std::vector<std::uint16_t> band_of_row(static_cast<std::size_t>(rows));
    for (int i = 0; i < count; ++i) {
      const auto row = [&](int k) {
        return std::min(static_cast<int>(static_cast<std::int64_t>(all) * k / count) * simd::kBlockSide, rows);
      };
      bands_.emplace_back(row(i), row(i + 1) - 1);
      std::fill(band_of_row.begin() + row(i), band_of_row.begin() + row(i + 1), static_cast<std::uint16_t>(i));
    }
    const std::vector<DealtBoxes> dealt = deal(band_of_row);
    executor_.for_each(bands_.size(), [&](std::size_t i, int) {
      for (const DealtBoxes& boxes : dealt) {
        for (int q = 0; q < BoxQueues::kQueues; ++q) draw(q, boxes.of(q, i), bands_[i]);
      }
    });
  }

  // And makes room for the picture's faces meanwhile.
  std::vector<DealtBoxes> deal(const std::vector<std::uint16_t>& band_of_row) {
    const std::size_t tasks = std::size_t{4} * executor_.threads();
    const std::size_t size = std::clamp(scene_.face_count() / tasks + 1, kChunk, kLargestDeal);
    std::vector<DealtBoxes> dealt((scene_.face_count() + size - 1) / size);
    std::vector<std::unique_ptr<BoxQueues>> queues_of;  // one a worker: they are large, and fresh memory is dear
    for (int i = 0; i < executor_.threads(); ++i) queues_of.push_back(std::make_unique<BoxQueues>(size));
    executor_.for_each(dealt.size() + 1, [&](std::size_t i, int worker) {
      if (i == dealt.size()) return resize_pages(nearest_.faces, grid_.count());
      BoxQueues& queues = *queues_of[static_cast<std::size_t>(worker)];
      find_boxes(i * size, size, queues);
      dealt[i].deal(queues, band_of_row, bands_.size());
    });
    return dealt;
  }

  simd::RasterTarget target(Band& band) {
    return samples_.target(band.first_row, band.last_row, &band.contests, band.fragments.get());
  }

  void draw(int queue, const simd::BoxQueue& boxes, Band& band) {
    for (std::size_t i = 0; i < boxes.size; i += simd::kBlockFaces) {
      const simd::FaceBoxes block = {boxes.faces + i, boxes.x0 + i, boxes.x1 + i,
                                     boxes.y0 + i,    boxes.y1 + i, std::min(simd::kBlockFaces, boxes.size - i)};
      if (queue < simd::kSmallQueues) {
        draw_small(queue, block, band);
      } else {
        draw_large(block, band);
      }
    }
  }

  void draw_small(int queue, const simd::FaceBoxes& boxes, Band& band) {
    simd::FaceBlock block;
    simd::set_up_faces(source_, view_.planes, view_.first_u, view_.first_v, boxes, block);
    if (queue <= simd::kLastBoxQueue) {
      simd::draw_faces(block, boxes, target(band));
    } else if (queue <= simd::kLastThinQueue) {
      simd::draw_thin_faces(block, boxes, target(band));
    } else {
      simd::draw_wide_faces(block, boxes, target(band));
    }
    for (std::size_t i = 0; block.has_unsure && i < boxes.count; ++i) {
      if (block.is_unsure[i]) draw_edge_on(boxes.faces[i], box(boxes, i), band);
    }
  }

  void draw_large(const simd::FaceBoxes& boxes, Band& band) {
    simd::LargeFace faces[simd::kBlockFaces];
    simd::set_up_large(source_, view_.planes, boxes.faces, boxes.count, nullptr, faces);
    for (std::size_t i = 0; i < boxes.count; ++i) {
      if (faces[i].is_unsure) {
        draw_edge_on(boxes.faces[i], box(boxes, i), band);
      } else {
        simd::draw_large(faces[i], boxes.faces[i], box(boxes, i), view_.first_u, view_.first_v, target(band));
      }
    }
  }

  // A face whose side doubles cannot tell: nothing if it is seen exactly edge-on.
  void draw_edge_on(std::uint32_t id, const simd::SampleBox& box, Band& band) {
    const auto s = static_cast<std::int8_t>(side(triangle_of(scene_, id), grid_.frame.position()));
    if (s == 0) return;
    simd::LargeFace face;
    simd::set_up_large(source_, view_.planes, &id, 1, &s, &face);
    simd::draw_large(face, id, box, view_.first_u, view_.first_v, target(band));
  }

  static simd::SampleBox box(const simd::FaceBoxes& boxes, std::size_t i) {
    return {boxes.x0[i], boxes.x1[i], boxes.y0[i], boxes.y1[i]};
  }

  void finish(Counters* counters) {
    if (nearest_.faces.empty()) resize_pages(nearest_.faces, grid_.count());
    const auto columns = static_cast<std::size_t>(grid_.columns());
    executor_.for_each(bands_.size(), [&](std::size_t i, int) {
      Band& band = bands_[i];
      band.contested = resolve_contests(scene_, grid_, {}, target(band), band.loose, &band.counters);
      std::sort(band.loose.begin(), band.loose.end());
      simd::copy_rows(target(band), columns, nearest_.faces.data(), columns);
    });
    if (counters != nullptr) counters->by_float += grid_.count();
    for (const Band& band : bands_) {
      if (counters != nullptr) counters->by_float -= band.contested;
      nearest_.loose.insert(nearest_.loose.end(), band.loose.begin(), band.loose.end());
      if (counters != nullptr) *counters += band.counters;
    }
  }

  const Scene& scene_;
  const SampleGrid& grid_;
  const PlaneView& view_;
  const Executor& executor_;
  Pages<float> points_;
  BlockRaster samples_;
  simd::FaceSource source_;
  NearestFaces nearest_;
  std::vector<Band> bands_;
};

}  // namespace

NearestFaces draw_plane_view(const Scene& scene, const SampleGrid& grid, const PlaneView& view,
                             const Executor& executor, Counters* counters) {
  return PlaneRaster(scene, grid, view, executor).run(counters);
}

}  // namespace facemap
