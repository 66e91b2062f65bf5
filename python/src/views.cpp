#include <facemap/viewpoint.h>
#include <facemap/visibility.h>
#include <facemap/visible_faces.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"

namespace facemap::python {
namespace {

using SharedScene = std::shared_ptr<Scene>;
using Faces = std::optional<Rows<FaceId>>;

constexpr std::size_t kFew = 1024;  ///< points or rays that take no time worth an interrupt

Viewpoint::Targets targets_of(const Rows<float>& points, const Faces& faces, float tolerance) {
  Viewpoint::Targets targets{rows_of<Vector>(points), {}, tolerance};
  if (faces) targets.faces = rows_of<FaceId>(*faces);
  return targets;
}

/// Does `work` with what it is to tell its progress to: nothing if there is little to do.
template <typename Work>
void ask(std::size_t questions, const Work& work, const py::object& progress = py::none()) {
  if (questions <= kFew && progress.is_none()) return call([&] { work(Viewpoint::Progress()); });
  call_interruptibly(
      [&](const Report& report) { work([&report](double fraction) { return report(fraction, "asking"); }); }, progress);
}

/// A viewpoint that keeps its scene.
class KeptView {
 public:
  KeptView(SharedScene scene, const Triple& origin, const Viewpoint::Options& options)
      : scene_(std::move(scene)), view_(*scene_, vector_of(origin), options) {}

  void prepare() const {
    call_interruptibly([this](const Report&) { view_.prepare(); });
  }

  py::array_t<bool> visible(const Rows<float>& points, const Faces& faces, float tolerance) const {
    const Viewpoint::Targets targets = targets_of(points, faces, tolerance);
    py::array_t<bool> answers(points.shape(0));
    const std::span<std::uint8_t> bytes = bytes_of(answers);
    ask(targets.points.size(), [&](const Viewpoint::Progress& p) { view_.visible(targets, bytes, p); });
    return answers;
  }

  py::array_t<FaceId> blocked_by(const Rows<float>& points, const Faces& faces) const {
    const Viewpoint::Targets targets = targets_of(points, faces, 0);
    py::array_t<FaceId> answers(points.shape(0));
    const std::span<FaceId> blockers = elements_of(answers);
    ask(targets.points.size(), [&](const Viewpoint::Progress& p) { view_.blocked_by(targets, blockers, p); });
    return answers;
  }

  py::tuple nearest(const Rows<float>& directions) const {
    const std::span<const Vector> rays = rows_of<Vector>(directions);
    py::array_t<FaceId> faces(directions.shape(0));
    py::array_t<float> distances(directions.shape(0));
    const std::span<FaceId> face_answers = elements_of(faces);
    const std::span<float> distance_answers = elements_of(distances);
    ask(rays.size(), [&](const Viewpoint::Progress& p) { view_.nearest(rays, face_answers, distance_answers, p); });
    return py::make_tuple(faces, distances);
  }

  py::tuple all_hits(const Rows<float>& directions) const {
    const std::span<const Vector> rays = rows_of<Vector>(directions);
    AllHits hits;
    ask(rays.size(), [&](const Viewpoint::Progress& p) { hits = view_.all_hits(rays, p); });
    std::vector<std::int64_t> begins(hits.begins.begin(), hits.begins.end());
    return py::make_tuple(given<std::int64_t>(std::move(begins)), given<FaceId>(std::move(hits.faces)),
                          given<float>(std::move(hits.distances)));
  }

  std::shared_ptr<Image> image(int width, int height, double field_angle, const Triple& sight) const {
    auto image = std::make_shared<Image>();
    ask(kFew + 1, [&](const Viewpoint::Progress& p) {
      *image = view_.image({width, height, field_angle, vector_of(sight)}, p);
    });
    return image;
  }

  py::tuple visible_faces() const {
    VisibleFaces found;
    ask(kFew + 1, [&](const Viewpoint::Progress& p) { found = view_.visible_faces(p); });
    return py::make_tuple(given<std::uint8_t>(std::move(found.faces)), given<float>(std::move(found.witnesses)),
                          given<std::uint8_t>(std::move(found.reasons)));
  }

  py::array_t<std::uint8_t> visible_vertices() const {
    std::vector<std::uint8_t> found;
    ask(kFew + 1, [&](const Viewpoint::Progress& p) { found = view_.visible_vertices(p); });
    return given<std::uint8_t>(std::move(found));
  }

  /// Tuples of the fields of CoveredPiece.
  py::list covered_pieces(FaceId face) const {
    std::vector<CoveredPiece> pieces;
    call_interruptibly([&](const Report&) { pieces = view_.covered_pieces(face); });
    py::list list;
    for (const CoveredPiece& piece : pieces) {
      list.append(py::make_tuple(piece.scale, piece.corners, piece.cover, triple_of(piece.direction)));
    }
    return list;
  }

  std::size_t memory_bytes() const { return view_.memory_bytes(); }

 private:
  SharedScene scene_;
  Viewpoint view_;
};

/// visibility() or visibility_along(), which ask of origins or directions.
using AskMany = void (*)(const Scene& scene, std::span<const Vector> from, const Viewpoint::Targets& targets,
                         std::span<std::uint8_t> bits, const VisibilityOptions& options,
                         const Viewpoint::Progress& progress);

constexpr std::size_t kRowsAtOnce =
    4096;  ///< few enough to be interrupted, and enough to pay for what is made for them

/// Rows of bits, one an origin or a direction.
py::array_t<std::uint8_t> bits_of(AskMany ask_many, const Scene& scene, const Rows<float>& from,
                                  const Rows<float>& points, const Faces& faces, float tolerance,
                                  const VisibilityOptions& options, const py::object& progress) {
  const std::span<const Vector> from_rows = rows_of<Vector>(from);
  const Viewpoint::Targets targets = targets_of(points, faces, tolerance);
  const auto row = static_cast<py::ssize_t>(visibility_row_bytes(targets.points.size()));
  py::array_t<std::uint8_t> rows({from.shape(0), row});
  const std::span<std::uint8_t> bits = elements_of(rows);
  call_interruptibly(
      [&](const Report& report) {
        const auto bytes = static_cast<std::size_t>(row);
        const std::size_t all = from_rows.size();
        for (std::size_t first = 0; first == 0 || first < all; first += kRowsAtOnce) {
          const std::size_t count = std::min(kRowsAtOnce, all - first);
          const auto tell = [&](double fraction) {
            const double done = static_cast<double>(first) + fraction * static_cast<double>(count);
            return report(all == 0 ? 1 : done / static_cast<double>(all), "asking");
          };
          if (!tell(0)) return;
          ask_many(scene, from_rows.subspan(first, count), targets, bits.subspan(first * bytes, count * bytes), options,
                   tell);
        }
      },
      progress);
  return rows;
}

void bind_bits(py::module_& module, const char* name, const char* from_name, AskMany ask_many) {
  module.def(
      name,
      [ask_many](const std::shared_ptr<Scene>& scene, const Rows<float>& from, const Rows<float>& points,
                 const Faces& faces, float tolerance, int threads, std::size_t memory, bool cut_outs,
                 std::uint64_t max_texture_pixels, const py::object& progress) {
        const VisibilityOptions options{threads, memory, cut_outs, max_texture_pixels};
        return bits_of(ask_many, *scene, from, points, faces, tolerance, options, progress);
      },
      py::arg("scene"), py::arg(from_name).noconvert(), py::arg("points").noconvert(), py::arg("faces").noconvert(),
      py::arg("tolerance"), py::arg("threads"), py::arg("memory"), py::arg("cut_outs"), py::arg("max_texture_pixels"),
      py::arg("progress"));
}

}  // namespace

void bind_views(py::module_& module) {
  py::class_<KeptView>(module, "View")
      .def(py::init([](SharedScene scene, const Triple& origin, int threads, bool cut_outs,
                       std::uint64_t max_texture_pixels) {
             std::unique_ptr<KeptView> view;
             call([&] {
               view = std::make_unique<KeptView>(std::move(scene), origin,
                                                 Viewpoint::Options{threads, cut_outs, max_texture_pixels});
             });
             return view;
           }),
           py::arg("scene"), py::arg("origin"), py::arg("threads"), py::arg("cut_outs"), py::arg("max_texture_pixels"))
      .def("prepare", &KeptView::prepare)
      .def("visible", &KeptView::visible, py::arg("points").noconvert(), py::arg("faces").noconvert(),
           py::arg("tolerance"))
      .def("blocked_by", &KeptView::blocked_by, py::arg("points").noconvert(), py::arg("faces").noconvert())
      .def("nearest", &KeptView::nearest, py::arg("directions").noconvert())
      .def("all_hits", &KeptView::all_hits, py::arg("directions").noconvert())
      .def("image", &KeptView::image, py::arg("width"), py::arg("height"), py::arg("field_angle"), py::arg("sight"))
      .def("visible_faces", &KeptView::visible_faces)
      .def("visible_vertices", &KeptView::visible_vertices)
      .def("covered_pieces", &KeptView::covered_pieces, py::arg("face"))
      .def_property_readonly("memory_bytes", &KeptView::memory_bytes);

  bind_bits(module, "visibility_bits", "origins", &visibility);
  bind_bits(module, "visibility_along_bits", "directions", &visibility_along);
}

}  // namespace facemap::python
