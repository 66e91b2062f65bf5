#include <facemap/error.h>
#include <facemap/image_file.h>

namespace facemap {
namespace {

/// As compositors know them: a layer's name, a point, the channel's.
std::vector<std::string> channel_names(Plane plane, int channels) {
  switch (plane) {
    case Plane::Id:
      return {"face.id"};
    case Plane::Depth:
      return {"range.Z"};
    case Plane::Z:
      return {"Z"};
    case Plane::Position:
      return {"P.X", "P.Y", "P.Z"};
    case Plane::Normal:
      return {"N.X", "N.Y", "N.Z"};
    case Plane::FaceNormal:
      return {"Ng.X", "Ng.Y", "Ng.Z"};
    case Plane::Albedo:
      return {"albedo.R", "albedo.G", "albedo.B"};
    case Plane::Uv:
      return {"UV.U", "UV.V"};
    case Plane::Object:
      return {"object.id"};
    case Plane::Material:
      return {"material.id"};
    case Plane::Shadows:
      return {"shadows.count"};
    case Plane::Lights:
      break;
  }
  std::vector<std::string> names;
  for (int i = 0; i < channels; ++i) names.push_back("lights." + std::to_string(i));
  return names;
}

}  // namespace

ExrLayers color_layers(const Image& image, ExrLayers::Storage storage) {
  return {{"R", "G", "B"}, color_plane(image), storage};
}

ExrLayers plane_layers(const Image& image, Plane plane) {
  const PlaneView view = plane_view(image, plane);
  return {channel_names(plane, view.channels), view, ExrLayers::Storage::Exact};
}

}  // namespace facemap
