#pragma once

#include <facemap/renderer.h>

#include <functional>
#include <memory>
#include <vector>

#include "material/material_table.h"
#include "parallel/executor.h"
#include "picture/cut_out_shadows.h"
#include "picture/lit_points.h"
#include "picture/nearest_faces.h"
#include "picture/sample_grid.h"
#include "picture/seen_points.h"
#include "picture/shadows.h"
#include "scene/closed_parts.h"
#include "scene/cut_outs.h"

namespace facemap {

class DividedPixels;
class EdgePixels;

/// What the transposed strategy keeps from picture to picture of one scene.
struct TransposedState {
  std::unique_ptr<ClosedParts> closed;  ///< made when first needed
  std::vector<ShadowScratch> scratch;   ///< one a worker
  KeptBounds bounds;                    ///< of the lights, once they are made
  KeptCutOutLists cut_outs;             ///< of the lights, if memory has no limit
};

/// All samples of a picture at once, or of bands of its rows: the camera's faces by the transposed way, the lights' by
/// either. Gives the colours and the planes, ids and lights, that Painter gives. Call paint() or look() once.
class WholePicture {
 public:
  /// Called now and then with the fraction done and the phase's name; it may throw.
  using Report = std::function<void(double, const char*)>;

  /// `cut_outs`: what materials take away from faces, or null. `lists`: of all lights if `asks_lists`, else of
  /// directional ones; those that are null there are made when they are asked, and dropped. The transposed way is then
  /// taken for lights with a place, and if `keeps_bounds` their bounds are made, if they are not.
  WholePicture(const Scene& scene, const std::shared_ptr<const CutOuts>& cut_outs, const View& view,
               const std::vector<Light>& lights, const Renderer::Options& options, const Executor& executor,
               TransposedState& state, const ListsOfLights& lists, bool asks_lists, bool keeps_bounds,
               const MaterialTable* materials, Renderer::Statistics& statistics, Report report);

  /// As Renderer::render.
  Image paint();

  /// The same with Sampling::Edges.
  Image paint_edges();

  /// As Renderer::look.
  Image look();

 private:
  /// What the samples of a grid see, and which lights reach it.
  struct Seen {
    SampleGrid grid;
    std::vector<FaceId> faces;  // one a sample
    SeenPoints points;          // masks: the lights that reach them
  };
  // Of at most `largest` samples, and as map_memory allows.
  std::vector<SampleGrid> bands(int per_side, std::size_t largest = kLargestBand) const;
  SampleGrid with_directions(SampleGrid band);
  std::size_t first_row_of(const SampleGrid& grid) const;
  NearestFaces nearest_faces(const SampleGrid& grid);
  Seen see(const SampleGrid& grid, NearestFaces nearest);
  Seen see(const SampleGrid& grid) { return see(grid, nearest_faces(grid)); }
  void prepare_lights(const SampleGrid& grid, const MovedPoints& moved, SeenPoints& seen);
  void ask_lights(const SampleGrid& grid, SeenPoints& seen);
  void ask_passing_lists(const SampleGrid& grid, const MovedPoints& moved, SeenPoints& seen);
  bool has_holes() const { return cut_outs_ != nullptr && cut_outs_->any(); }
  Image empty_image(int per_side) const;
  void paint_centres(EdgePixels& edges, Image& image);
  NearestFaces faces_of_parts(const SampleGrid& grid);
  void divide(const SampleGrid& grid, int rows, NearestFaces nearest, bool spreads, EdgePixels& edges,
              DividedPixels& divided);
  void put_planes(Seen&& seen, Image& image) const;
  void report(double share, const char* phase);

  const Scene& scene_;
  const std::shared_ptr<const CutOuts>& cut_outs_;
  const Scene &solid_, &shown_;  // its faces without holes, and all that are there somewhere
  const View& view_;
  const std::vector<Light>& lights_;
  const Renderer::Options& options_;
  const Executor& executor_;
  TransposedState& state_;
  const LightPlaces places_;
  std::vector<const LightLists*> lists_;  // one a light; null: there are none that are kept
  bool transposes_;                       // there are lights that are not
  bool keeps_bounds_;
  const MaterialTable* materials_;  // null: all is white
  Renderer::Statistics& statistics_;
  Report report_;
  bool paints_ = false;
  static constexpr std::size_t kLargestBand = std::size_t{1} << 22;  // samples: a picture of 2048 x 2048 is one

  std::vector<Color> colors_;  // of the samples of a band, background to begin with
  std::size_t bands_done_ = 0, band_count_ = 1;
};

}  // namespace facemap
