#include <facemap/renderer.h>
#include <facemap/space_vector.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"

namespace facemap::python {
namespace {

using SharedScene = std::shared_ptr<Scene>;

Renderer::Sampling sampling_of(bool at_edges) {
  return at_edges ? Renderer::Sampling::Edges : Renderer::Sampling::Grid;
}

/// A camera of which some things are made up.
struct WantedCamera {
  std::optional<Triple> position, look_at, up;
  std::optional<double> height;
  View view;  ///< the lens
};

/// Whether two directions are so nearly parallel that float32 cannot tell which way is right.
bool is_nearly_parallel(const Vector& a, const Vector& b) {
  constexpr double kSine = 1e-6;  // about 8 units in the last place of float32
  const DVector cross = glm::cross(DVector(a), DVector(b));
  return glm::dot(cross, cross) <= kSine * kSine * glm::dot(DVector(a), DVector(a)) * glm::dot(DVector(b), DVector(b));
}

/// As the program completes it; `up` is the world's.
View complete_view(const Scene& scene, const WantedCamera& wanted, const Triple& world_up) {
  const BoundingBall ball{scene.centre(), scene.bounding_radius()};
  const Vector up = vector_of(world_up), centre(ball.centre);
  View view = wanted.view;
  view.up = wanted.up ? vector_of(*wanted.up) : up;
  const View made_up = make_up_view(ball, up, view);
  view.height = wanted.height.value_or(static_cast<float>(made_up.height));
  if (wanted.position) {
    view.position = vector_of(*wanted.position);
    view.look_at = wanted.look_at ? vector_of(*wanted.look_at) : centre;
    if (!wanted.look_at && view.position == centre) view.look_at = centre + Vector(0, 0, -1);
  } else {
    view.look_at = wanted.look_at ? vector_of(*wanted.look_at) : made_up.look_at;
    view.position = made_up.position + (view.look_at - made_up.look_at);
  }
  if (!wanted.up && is_nearly_parallel(view.look_at - view.position, view.up)) {
    view.up = Vector(view.up.z, view.up.x, view.up.y);
  }
  return view;
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

using Pose = std::array<std::array<double, 4>, 3>;

/// Where OpenCV's R|t (camera = R world + t) stands, the point that it looks at, and up.
py::tuple view_of_pose(const Pose& m) {
  Vector position(0);
  for (int i = 0; i < 3; ++i) {
    position[i] = static_cast<float>(-(m[0][i] * m[0][3] + m[1][i] * m[1][3] + m[2][i] * m[2][3]));
  }
  // Far away, so that rounding the point to float32 turns the sight by no more than 2^-23.
  const float largest = std::max({std::fabs(position.x), std::fabs(position.y), std::fabs(position.z), 1.0f});
  const Vector look_at(DVector(position) + DVector(m[2][0], m[2][1], m[2][2]) * (64.0 * largest));
  return py::make_tuple(triple_of(position), triple_of(look_at), Triple{-m[1][0], -m[1][1], -m[1][2]});
}

/// A picture, or several one after the other, of a scene under the same lights; keeps the scene.
class Painter {
 public:
  Painter(SharedScene scene, const View& view, std::vector<Light> lights, const Renderer::Options& options)
      : scene_(std::move(scene)), renderer_(*scene_, view, std::move(lights), options) {}

  std::shared_ptr<Image> render(const std::optional<View>& view, const py::object& progress) {
    auto image = std::make_shared<Image>();
    if (view) renderer_.set_view(*view);
    call_interruptibly([&](const Report& report) { *image = renderer_.render(report); }, progress);
    return image;
  }

  py::dict statistics() const {
    const Renderer::Statistics& s = renderer_.statistics();
    py::dict dict;
    dict["camera_map_ms"] = s.camera_map_ms;
    dict["light_maps_ms"] = s.light_maps_ms;
    dict["shade_ms"] = s.shade_ms;
    dict["camera_queries"] = s.camera_queries;
    dict["light_queries"] = s.light_queries;
    dict["map_bytes"] = s.map_bytes;
    dict["strategy"] = s.strategy == Renderer::Strategy::Lists ? "lists" : "transposed";
    dict["reason"] = s.reason;
    dict["target"] = s.target;
    dict["threads"] = s.threads;
    return dict;
  }

  std::vector<std::string> warnings() const { return renderer_.statistics().warnings; }

 private:
  SharedScene scene_;
  Renderer renderer_;
};

void bind_options(py::module_& module) {
  using Options = Renderer::Options;
  py::enum_<Renderer::Filter>(module, "Filter")
      .value("box", Renderer::Filter::Box)
      .value("blackman-harris", Renderer::Filter::BlackmanHarris);
  py::enum_<Renderer::Normals>(module, "Normals")
      .value("flat", Renderer::Normals::Flat)
      .value("smooth", Renderer::Normals::Smooth);
  py::enum_<Renderer::Falloff>(module, "Falloff")
      .value("constant", Renderer::Falloff::Constant)
      .value("inverse-square", Renderer::Falloff::InverseSquare);
  py::enum_<Renderer::Strategy>(module, "Strategy")
      .value("auto", Renderer::Strategy::Auto)
      .value("lists", Renderer::Strategy::Lists)
      .value("transposed", Renderer::Strategy::Transposed);
  py::enum_<Renderer::LightMaps>(module, "LightMaps")
      .value("auto", Renderer::LightMaps::Auto)
      .value("keep", Renderer::LightMaps::Keep)
      .value("none", Renderer::LightMaps::None);
  py::enum_<Builder>(module, "Builder").value("cover", Builder::Cover).value("fill", Builder::Fill);
  py::class_<Options>(module, "RenderOptions")
      .def(py::init())
      .def_readwrite("width", &Options::width)
      .def_readwrite("height", &Options::height)
      .def_readwrite("samples", &Options::samples)
      .def_readwrite("filter", &Options::filter)
      .def_readwrite("filter_width", &Options::filter_width)
      .def_readwrite("normals", &Options::normals)
      .def_readwrite("terminator_fix", &Options::shadow_terminator_fix)
      .def_readwrite("falloff", &Options::falloff)
      .def_readwrite("materials", &Options::materials)
      .def_readwrite("max_texture_pixels", &Options::max_texture_pixels)
      .def_readwrite("builder", &Options::builder)
      .def_readwrite("strategy", &Options::strategy)
      .def_readwrite("light_maps", &Options::light_maps)
      .def_readwrite("threads", &Options::threads)
      .def_readwrite("map_memory", &Options::map_memory)
      .def("set_edges", [](Options& o, bool at_edges) { o.sampling = sampling_of(at_edges); })
      .def("set_background", [](Options& o, const Triple& c) { o.background = color_of(c); })
      .def("set_ambient", [](Options& o, const Triple& c) { o.ambient = color_of(c); })
      .def("set_sky_up", [](Options& o, const Triple& c) { o.sky_up = color_of(c); })
      .def("set_sky_down", [](Options& o, const Triple& c) { o.sky_down = color_of(c); })
      .def("set_up", [](Options& o, const Triple& v) { o.up = vector_of(v); })
      .def("set_crop",
           [](Options& o, const std::array<int, 4>& c) {
             o.crop = PixelBox{c[0], c[1], c[2], c[3]};
           })
      .def("add_plane", [](Options& o, const std::string& name) {
        const std::optional<Plane> plane = plane_named(name);
        if (!plane) throw py::value_error("there is no plane " + name);
        o.planes.add(*plane);
      });
}

void bind_cameras(py::module_& module) {
  py::enum_<ProjectionKind>(module, "Projection")
      .value("surface", ProjectionKind::Surface)
      .value("plane", ProjectionKind::Plane);
  py::enum_<CubeLayout>(module, "CubeLayout")
      .value("3x2", CubeLayout::Grid3x2)
      .value("6x1", CubeLayout::Row6x1)
      .value("1x6", CubeLayout::Column1x6);
  py::class_<Lens>(module, "Lens")
      .def_static("equirect", &Lens::equirectangular)
      .def_static("cube", &Lens::cube_map)
      .def_static("surface", &Lens::surface)
      .def_static("plane", &Lens::plane)
      .def_static("opencv",
                  [](const std::array<double, 4>& k, const std::vector<double>& distortion, int width, int height) {
                    return Lens::opencv_pinhole({k[0], k[1], k[2], k[3]}, PinholeDistortion::from_opencv(distortion),
                                                width, height);
                  })
      .def_static("opencv_fisheye",
                  [](const std::array<double, 4>& k, const std::vector<double>& distortion, int width, int height) {
                    return Lens::opencv_fisheye({k[0], k[1], k[2], k[3]}, FisheyeDistortion::from_opencv(distortion),
                                                width, height);
                  });
  py::class_<WantedCamera>(module, "WantedCamera")
      .def(py::init())
      .def_readwrite("position", &WantedCamera::position)
      .def_readwrite("look_at", &WantedCamera::look_at)
      .def_readwrite("up", &WantedCamera::up)
      .def_readwrite("height", &WantedCamera::height)
      .def("set_projection", [](WantedCamera& c, ProjectionKind kind) { c.view.projection = kind; })
      .def("set_field_angle", [](WantedCamera& c, double radians) { c.view.field_angle = radians; })
      .def("set_parallel", [](WantedCamera& c) { c.view.is_parallel = true; })
      .def("set_lens", [](WantedCamera& c, const Lens& lens) { c.view.lens = lens; });
  py::class_<View>(module, "CompleteCamera")
      .def_property_readonly("position", [](const View& v) { return triple_of(v.position); })
      .def_property_readonly("look_at", [](const View& v) { return triple_of(v.look_at); })
      .def_property_readonly("up", [](const View& v) { return triple_of(v.up); })
      .def("directions", &directions)
      .def_readonly("height", &View::height);
  module.def("complete_view", &complete_view, py::arg("scene"), py::arg("camera"), py::arg("up"));
  module.def("view_of_pose", &view_of_pose, py::arg("pose"));
}

}  // namespace

void bind_pictures(py::module_& module) {
  bind_options(module);
  bind_cameras(module);
  module.def(
      "make_up_lights",
      [](const Scene& scene, const Triple& up) {
        return make_up_lights(BoundingBall{scene.centre(), scene.bounding_radius()}, vector_of(up));
      },
      py::arg("scene"), py::arg("up"));
  py::class_<Painter>(module, "Painter")
      .def(py::init<SharedScene, const View&, std::vector<Light>, const Renderer::Options&>(), py::arg("scene"),
           py::arg("view"), py::arg("lights"), py::arg("options"))
      .def("render", &Painter::render, py::arg("view") = std::nullopt, py::arg("progress") = py::none())
      .def_property_readonly("statistics", &Painter::statistics)
      .def_property_readonly("warnings", &Painter::warnings);
}

}  // namespace facemap::python
