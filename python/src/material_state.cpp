#include "material_state.h"

#include <string>
#include <string_view>
#include <type_traits>

namespace facemap::python {
namespace {

/// A record with its name taken off, as bytes. All that is left must be numbers.
struct PlainMaterial {
  Vector ambient, diffuse, specular, emission;
  float shininess, optical_density, opacity, metallic, roughness, alpha_cutoff;
  int illumination;
  Material::Kind kind;
  Material::Alpha alpha;
  bool is_halo, is_double_sided, is_unlit;
  TextureUse diffuse_map, opacity_map, specular_map, shininess_map, emission_map, metallic_map, roughness_map,
      normal_map, bump_map;
};

PlainMaterial plain(const Material& m) {
  return {m.ambient,         m.diffuse,      m.specular,      m.emission,     m.shininess,
          m.optical_density, m.opacity,      m.metallic,      m.roughness,    m.alpha_cutoff,
          m.illumination,    m.kind,         m.alpha,         m.is_halo,      m.is_double_sided,
          m.is_unlit,        m.diffuse_map,  m.opacity_map,   m.specular_map, m.shininess_map,
          m.emission_map,    m.metallic_map, m.roughness_map, m.normal_map,   m.bump_map};
}

Material whole(std::string name, const PlainMaterial& p) {
  Material m;
  m.name = std::move(name);
  m.ambient = p.ambient;
  m.diffuse = p.diffuse;
  m.specular = p.specular;
  m.emission = p.emission;
  m.shininess = p.shininess;
  m.optical_density = p.optical_density;
  m.opacity = p.opacity;
  m.metallic = p.metallic;
  m.roughness = p.roughness;
  m.alpha_cutoff = p.alpha_cutoff;
  m.illumination = p.illumination;
  m.kind = p.kind;
  m.alpha = p.alpha;
  m.is_halo = p.is_halo;
  m.is_double_sided = p.is_double_sided;
  m.is_unlit = p.is_unlit;
  m.diffuse_map = p.diffuse_map;
  m.opacity_map = p.opacity_map;
  m.specular_map = p.specular_map;
  m.shininess_map = p.shininess_map;
  m.emission_map = p.emission_map;
  m.metallic_map = p.metallic_map;
  m.roughness_map = p.roughness_map;
  m.normal_map = p.normal_map;
  m.bump_map = p.bump_map;
  return m;
}

struct PlainCamera {
  Vector position, look_at, up;
  bool is_parallel;
  double field_angle, height;
};

template <typename Record>
py::bytes bytes_of(const Record& record) {
  static_assert(std::is_trivially_copyable_v<Record>);
  return {reinterpret_cast<const char*>(&record), sizeof record};
}

template <typename Record>
Record record_from(const py::handle& bytes) {
  const auto text = bytes.cast<std::string_view>();
  Record record;
  if (text.size() != sizeof record) throw py::value_error("a scene's state is of another version");
  std::copy(text.begin(), text.end(), reinterpret_cast<char*>(&record));
  return record;
}

template <typename Values, typename State>
py::tuple each(const Values& values, const State& state) {
  py::tuple states(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) states[i] = state(values[i]);
  return states;
}

template <typename Value, typename From>
std::vector<Value> each_from(const py::tuple& states, const From& from) {
  std::vector<Value> values;
  for (const py::handle state : states) values.push_back(from(state.cast<py::tuple>()));
  return values;
}

}  // namespace

py::tuple states_of(const std::vector<Material>& materials) {
  return each(materials, [](const Material& m) { return py::make_tuple(m.name, bytes_of(plain(m))); });
}

py::tuple states_of(const std::vector<TextureImage>& images) {
  return each(images, [](const TextureImage& image) {
    const std::string_view bytes(reinterpret_cast<const char*>(image.bytes.data()), image.bytes.size());
    return py::make_tuple(image.name, image.file.string(), py::bytes(bytes.data(), bytes.size()));
  });
}

py::tuple states_of(const std::vector<ModelCamera>& cameras) {
  return each(cameras, [](const ModelCamera& c) {
    return py::make_tuple(c.name,
                          bytes_of(PlainCamera{c.position, c.look_at, c.up, c.is_parallel, c.field_angle, c.height}));
  });
}

std::vector<Material> materials_from(const py::tuple& states) {
  return each_from<Material>(states, [](const py::tuple& state) {
    return whole(state[0].cast<std::string>(), record_from<PlainMaterial>(state[1]));
  });
}

std::vector<TextureImage> images_from(const py::tuple& states) {
  return each_from<TextureImage>(states, [](const py::tuple& state) {
    const auto bytes = state[2].cast<std::string_view>();
    return TextureImage{state[0].cast<std::string>(), state[1].cast<std::string>(), {bytes.begin(), bytes.end()}};
  });
}

std::vector<ModelCamera> cameras_from(const py::tuple& states) {
  return each_from<ModelCamera>(states, [](const py::tuple& state) {
    const auto p = record_from<PlainCamera>(state[1]);
    return ModelCamera{
        state[0].cast<std::string>(), p.position, p.look_at, p.up, p.is_parallel, p.field_angle, p.height};
  });
}

}  // namespace facemap::python
