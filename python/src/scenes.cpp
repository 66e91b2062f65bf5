#include <facemap/affine.h>
#include <facemap/model.h>
#include <facemap/scene.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <optional>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"
#include "material_state.h"
#include "pickling.h"

namespace facemap::python {
namespace {

using SharedScene = std::shared_ptr<Scene>;
using Matrix = std::array<std::array<double, 4>, 4>;

SharedScene scene_of(Model model, int threads) { return std::make_shared<Scene>(std::move(model), threads); }

template <typename Row, typename Number>
std::vector<Row> copied(const std::optional<Rows<Number>>& array) {
  if (!array) return {};
  const std::span<const Row> rows = rows_of<Row>(*array);
  return {rows.begin(), rows.end()};
}

SharedScene load(const std::filesystem::path& path, std::uint64_t max_bytes, std::uint64_t max_faces,
                 bool allow_outside, int threads) {
  SharedScene scene;
  call_interruptibly([&](const Report&) {
    scene = std::make_shared<Scene>(Scene::load(path, ModelLimits{max_bytes, max_faces, threads, allow_outside}));
  });
  return scene;
}

/// What every vertex may have beside its place.
struct VertexArrays {
  std::optional<Rows<float>> normals, texture_coordinates, colours;
};

SharedScene from_arrays(const Rows<float>& vertices, const Rows<std::uint32_t>& faces, const VertexArrays& more,
                        const std::optional<Triple>& colour, int threads) {
  Model model;
  Mesh& mesh = model.mesh;
  mesh.positions = copied<Vector, float>(vertices);
  mesh.triangles = copied<Corners, std::uint32_t>(faces);
  mesh.normals = copied<Vector>(more.normals);
  mesh.texture_coordinates = copied<glm::vec2>(more.texture_coordinates);
  mesh.colours = copied<Vector>(more.colours);
  if (more.normals) mesh.normal_corners = mesh.triangles;
  if (more.texture_coordinates) mesh.texture_corners = mesh.triangles;
  if (colour) {
    model.materials.resize(1);
    model.materials[0].diffuse = vector_of(*colour);
    mesh.triangle_materials.assign(mesh.triangles.size(), 0);
  }
  SharedScene scene;
  call_interruptibly([&](const Report&) { scene = scene_of(std::move(model), threads); });
  return scene;
}

/// All that a scene was made from.
Model model_of(const Scene& scene) {
  Model model;
  model.mesh = scene.mesh();
  model.materials = scene.materials();
  model.images = scene.images();
  model.lights = scene.lights();
  model.cameras = scene.cameras();
  model.objects = scene.objects();
  model.up = scene.up();
  model.warnings = scene.report().warnings;
  if (model.objects.empty()) return model;
  model.triangle_objects.resize(scene.face_count());
  for (std::size_t face = 0; face < scene.face_count(); ++face) model.triangle_objects[face] = scene.object_of(face);
  return model;
}

Affine affine_of(const Matrix& m) {
  const auto column = [&](std::size_t i) { return DVector(m[0][i], m[1][i], m[2][i]); };
  return {column(0), column(1), column(2), column(3)};
}

SharedScene moved(const SharedScene& scene, const Matrix& matrix, int threads) {
  SharedScene result;
  call_interruptibly(
      [&](const Report&) { result = scene_of(transformed(model_of(*scene), affine_of(matrix)), threads); });
  return result;
}

SharedScene joined(const std::vector<SharedScene>& parts, int threads) {
  SharedScene scene;
  call_interruptibly([&](const Report&) {
    Model sum = model_of(*parts.at(0));
    for (std::size_t i = 1; i < parts.size(); ++i) append(sum, model_of(*parts[i]));
    scene = scene_of(std::move(sum), threads);
  });
  return scene;
}

/// For pickle: the arrays as bytes, so that numbers come back as they are.
py::tuple state_of(const Scene& scene) {
  const Model model = model_of(scene);
  const Mesh& mesh = model.mesh;
  return py::make_tuple(
      py::make_tuple(bytes_of(mesh.positions), bytes_of(mesh.normals), bytes_of(mesh.texture_coordinates),
                     bytes_of(mesh.colours), bytes_of(mesh.triangles), bytes_of(mesh.normal_corners),
                     bytes_of(mesh.texture_corners), bytes_of(mesh.polygons), bytes_of(mesh.triangle_materials)),
      states_of(model.materials), states_of(model.images), bytes_of(model.lights), states_of(model.cameras),
      model.objects, bytes_of(model.triangle_objects),
      model.up ? py::object(py::cast(triple_of(*model.up))) : py::object(py::none()), model.warnings);
}

SharedScene scene_from(const py::tuple& state) {
  Model model;
  const py::tuple arrays = state[0];
  model.mesh = {
      rows_from<Vector>(arrays[0]),  rows_from<Vector>(arrays[1]),        rows_from<glm::vec2>(arrays[2]),
      rows_from<Vector>(arrays[3]),  rows_from<Corners>(arrays[4]),       rows_from<Corners>(arrays[5]),
      rows_from<Corners>(arrays[6]), rows_from<std::uint32_t>(arrays[7]), rows_from<std::uint32_t>(arrays[8])};
  model.materials = materials_from(state[1]);
  model.images = images_from(state[2]);
  model.lights = rows_from<Light>(state[3]);
  model.cameras = cameras_from(state[4]);
  model.objects = state[5].cast<std::vector<std::string>>();
  model.triangle_objects = rows_from<std::uint32_t>(state[6]);
  if (!state[7].is_none()) model.up = vector_of(state[7].cast<Triple>());
  model.warnings = state[8].cast<std::vector<std::string>>();
  return scene_of(std::move(model), 0);
}

py::array vertices(const py::object& scene) {
  const std::vector<Vector>& positions = scene.cast<const Scene&>().mesh().positions;
  return borrowed(&positions[0].x, {static_cast<py::ssize_t>(positions.size()), 3}, scene);
}

py::array faces(const py::object& scene) {
  const std::vector<Corners>& triangles = scene.cast<const Scene&>().mesh().triangles;
  return borrowed(triangles[0].data(), {static_cast<py::ssize_t>(triangles.size()), 3}, scene);
}

py::dict odd_faces(const Scene& scene) {
  py::dict odd;
  odd["zero_area"] = scene.odd_faces().zero_area;
  odd["repeated_vertex"] = scene.odd_faces().repeated_vertex;
  odd["duplicate"] = scene.odd_faces().duplicate;
  return odd;
}

}  // namespace

void bind_scenes(py::module_& module) {
  py::class_<Scene, SharedScene> scene(module, "Scene");
  scene.def_property_readonly("vertices", [](const py::object& self) { return vertices(self); })
      .def_property_readonly("faces", [](const py::object& self) { return faces(self); })
      .def_property_readonly("kept_faces",
                             [](const py::object& self) {
                               const std::vector<std::uint32_t>& kept = self.cast<const Scene&>().kept_faces();
                               return borrowed(kept.data(), {static_cast<py::ssize_t>(kept.size())}, self);
                             })
      .def_property_readonly("face_count", &Scene::face_count)
      .def_property_readonly("lower", [](const Scene& self) { return triple_of(self.lower()); })
      .def_property_readonly("upper", [](const Scene& self) { return triple_of(self.upper()); })
      .def_property_readonly("odd_faces", &odd_faces)
      .def_property_readonly("objects", &Scene::objects)
      .def_property_readonly("materials",
                             [](const Scene& self) {
                               std::vector<std::string> names;
                               for (const Material& material : self.materials()) names.push_back(material.name);
                               return names;
                             })
      .def_property_readonly("lights", &Scene::lights)
      .def_property_readonly("cameras", &Scene::cameras)
      .def_property_readonly("warnings", [](const Scene& self) { return self.report().warnings; })
      .def_property_readonly("up", [](const Scene& self) -> std::optional<Triple> {
        if (!self.up()) return std::nullopt;
        return triple_of(*self.up());
      });
  add_pickling<Scene>(scene, &state_of, &scene_from);

  module.def("load", &load, py::arg("path"), py::arg("max_bytes"), py::arg("max_faces"), py::arg("allow_outside"),
             py::arg("threads"));
  module.def(
      "scene_from_arrays",
      [](const Rows<float>& corners, const Rows<std::uint32_t>& triangles, std::optional<Rows<float>> normals,
         std::optional<Rows<float>> texture_coordinates, std::optional<Rows<float>> colours,
         const std::optional<Triple>& colour, int threads) {
        return from_arrays(corners, triangles, {normals, texture_coordinates, colours}, colour, threads);
      },
      py::arg("vertices").noconvert(), py::arg("faces").noconvert(), py::arg("normals").noconvert(),
      py::arg("texture_coordinates").noconvert(), py::arg("colours").noconvert(), py::arg("colour"),
      py::arg("threads"));
  module.def("moved", &moved, py::arg("scene"), py::arg("transform"), py::arg("threads"));
  module.def("joined", &joined, py::arg("parts"), py::arg("threads"));
}

}  // namespace facemap::python
