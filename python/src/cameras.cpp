#include <facemap/lens.h>
#include <facemap/renderer.h>
#include <facemap/space_vector.h>
#include <facemap/view_place.h>
#include <pybind11/stl.h>

#include <optional>
#include <utility>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"

namespace facemap::python {
namespace {

using Pose = std::array<std::array<double, 4>, 3>;

/// A camera of which some things are made up.
struct WantedCamera {
  ViewPlace place;
  View lens;
};

/// As the program completes it; `up` is the world's.
View complete(const Scene& scene, const WantedCamera& wanted, const Triple& up) {
  return complete_view({scene.centre(), scene.bounding_radius()}, vector_of(up), wanted.place, wanted.lens);
}

/// What may be None.
auto optional_vector(std::optional<Vector> ViewPlace::*field) {
  return std::pair(
      [field](const WantedCamera& c) -> std::optional<Triple> {
        const std::optional<Vector>& vector = c.place.*field;
        if (!vector) return std::nullopt;
        return triple_of(*vector);
      },
      [field](WantedCamera& c, const std::optional<Triple>& value) {
        c.place.*field = value ? std::optional(vector_of(*value)) : std::nullopt;
      });
}

Lens lens_of(const View& view, int width, int height) {
  return view.lens ? *view.lens : Lens(Projection(view.projection, view.field_angle, width, height));
}

/// The directions of the rays through the pixels' centres; zero where the lens has none.
py::array_t<float> directions(const View& view, int width, int height) {
  const auto frame = SpaceVector::looking_at(view.position, view.look_at, view.up);
  const Lens lens = lens_of(view, width, height);
  py::array_t<float> rows({py::ssize_t{height}, py::ssize_t{width}, py::ssize_t{3}});
  float* out = rows.mutable_data();
  call([&] {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const std::optional<DVector> local = lens.direction({x + 0.5, y + 0.5});
        const Vector direction = local ? Vector(frame.world_from_local(*local)) : Vector(0);
        for (int k = 0; k < 3; ++k) *out++ = direction[k];
      }
    }
  });
  return rows;
}

}  // namespace

void bind_cameras(py::module_& module) {
  py::enum_<ProjectionKind>(module, "Projection")
      .value("surface", ProjectionKind::Surface)
      .value("plane", ProjectionKind::Plane);
  py::enum_<CubeLayout>(module, "CubeLayout")
      .value("3x2", CubeLayout::Grid3x2)
      .value("6x1", CubeLayout::Row6x1)
      .value("1x6", CubeLayout::Column1x6);
  py::class_<Lens>(module, "Lens")
      .def_static("equirect", &Lens::equirectangular, py::arg("width"), py::arg("height"))
      .def_static("cube", &Lens::cube_map, py::arg("layout"), py::arg("face_size"))
      .def_static("surface", &Lens::surface, py::arg("field_angle"), py::arg("width"), py::arg("height"))
      .def_static("plane", &Lens::plane, py::arg("field_angle"), py::arg("width"), py::arg("height"))
      .def_static(
          "opencv",
          [](const std::array<double, 4>& k, const std::vector<double>& distortion, int width, int height) {
            return Lens::opencv_pinhole({k[0], k[1], k[2], k[3]}, PinholeDistortion::from_opencv(distortion), width,
                                        height);
          },
          py::arg("matrix"), py::arg("distortion"), py::arg("width"), py::arg("height"))
      .def_static(
          "opencv_fisheye",
          [](const std::array<double, 4>& k, const std::vector<double>& distortion, int width, int height) {
            return Lens::opencv_fisheye({k[0], k[1], k[2], k[3]}, FisheyeDistortion::from_opencv(distortion), width,
                                        height);
          },
          py::arg("matrix"), py::arg("distortion"), py::arg("width"), py::arg("height"));
  const auto position = optional_vector(&ViewPlace::position);
  const auto look_at = optional_vector(&ViewPlace::look_at);
  const auto up = optional_vector(&ViewPlace::up);
  py::class_<WantedCamera>(module, "WantedCamera")
      .def(py::init())
      .def_property("position", position.first, position.second)
      .def_property("look_at", look_at.first, look_at.second)
      .def_property("up", up.first, up.second)
      .def(
          "set_pose", [](WantedCamera& c, const Pose& pose) { c.place = ViewPlace::of_opencv(pose); }, py::arg("pose"))
      .def(
          "set_height", [](WantedCamera& c, double height) { c.place.height = height; }, py::arg("height"))
      .def(
          "set_projection", [](WantedCamera& c, ProjectionKind kind) { c.lens.projection = kind; }, py::arg("kind"))
      .def(
          "set_field_angle", [](WantedCamera& c, double radians) { c.lens.field_angle = radians; }, py::arg("radians"))
      .def("set_parallel", [](WantedCamera& c) { c.lens.is_parallel = true; })
      .def(
          "set_lens", [](WantedCamera& c, const Lens& lens) { c.lens.lens = lens; }, py::arg("lens"));
  py::class_<View>(module, "CompleteCamera")
      .def_property_readonly("position", [](const View& v) { return triple_of(v.position); })
      .def_property_readonly("look_at", [](const View& v) { return triple_of(v.look_at); })
      .def_property_readonly("up", [](const View& v) { return triple_of(v.up); })
      .def("directions", &directions, py::arg("width"), py::arg("height"))
      .def_readonly("height", &View::height);
  module.def("complete_view", &complete, py::arg("scene"), py::arg("camera"), py::arg("up"));
}

}  // namespace facemap::python
