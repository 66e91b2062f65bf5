#include <facemap/renderer.h>
#include <pybind11/stl.h>

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
      .def(
          "set_edges", [](Options& o, bool at_edges) { o.sampling = sampling_of(at_edges); }, py::arg("at_edges"))
      .def(
          "set_background", [](Options& o, const Triple& c) { o.background = color_of(c); }, py::arg("color"))
      .def(
          "set_ambient", [](Options& o, const Triple& c) { o.ambient = color_of(c); }, py::arg("color"))
      .def(
          "set_sky_up", [](Options& o, const Triple& c) { o.sky_up = color_of(c); }, py::arg("color"))
      .def(
          "set_sky_down", [](Options& o, const Triple& c) { o.sky_down = color_of(c); }, py::arg("color"))
      .def(
          "set_up", [](Options& o, const Triple& v) { o.up = vector_of(v); }, py::arg("up"))
      .def(
          "set_crop",
          [](Options& o, const std::array<int, 4>& c) {
            o.crop = PixelBox{c[0], c[1], c[2], c[3]};
          },
          py::arg("box"))
      .def(
          "add_plane",
          [](Options& o, const std::string& name) {
            const std::optional<Plane> plane = plane_named(name);
            if (!plane) throw py::value_error("there is no plane " + name);
            o.planes.add(*plane);
          },
          py::arg("name"));
}

}  // namespace

void bind_pictures(py::module_& module) {
  bind_options(module);
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
