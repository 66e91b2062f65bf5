#include <facemap/plane.h>

namespace facemap {
namespace {

struct NamedPlane {
  Plane plane;
  const char* name;
};

constexpr NamedPlane kNames[] = {
    {Plane::Id, "id"},         {Plane::Depth, "depth"},
    {Plane::Z, "z"},           {Plane::Position, "position"},
    {Plane::Normal, "normal"}, {Plane::FaceNormal, "face-normal"},
    {Plane::Albedo, "albedo"}, {Plane::Uv, "uv"},
    {Plane::Object, "object"}, {Plane::Material, "material"},
    {Plane::Lights, "lights"}, {Plane::Shadows, "shadows"},
};

std::vector<Plane> planes_of_table() {
  std::vector<Plane> planes;
  for (const NamedPlane& named : kNames) planes.push_back(named.plane);
  return planes;
}

}  // namespace

const std::vector<Plane>& all_planes() {
  static const std::vector<Plane> planes = planes_of_table();
  return planes;
}

const char* name_of(Plane plane) { return kNames[static_cast<int>(plane)].name; }

std::optional<Plane> plane_named(std::string_view name) {
  for (const NamedPlane& named : kNames) {
    if (name == named.name) return named.plane;
  }
  return std::nullopt;
}

}  // namespace facemap
