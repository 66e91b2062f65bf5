#include <facemap/error.h>
#include <facemap/image_file.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace facemap {
namespace {

/// The colour whose sRGB levels are 255 times these, rounded; NaN is 0.
Color from_levels(double r, double g, double b) {
  const auto level = [](double share) {
    return share > 0 ? static_cast<std::uint32_t>(std::floor(255 * std::min(share, 1.0) + 0.5)) : 0u;
  };
  return Color::from_24_bit(level(r) << 16 | level(g) << 8 | level(b));
}

Color grey(double share) { return from_levels(share, share, share); }

/// The finite values from the least to the largest.
struct Extent {
  float low = std::numeric_limits<float>::infinity(), high = -std::numeric_limits<float>::infinity();

  void add(float value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// 0 at the least, 1 at the largest.
  double share(float value) const { return low < high ? (double{value} - low) / (double{high} - low) : 0; }
};

/// The nearest is white, the farthest dark grey.
std::vector<Color> of_distances(const std::vector<float>& distances) {
  constexpr double kFarthest = 0.15;
  Extent extent;
  for (const float distance : distances) extent.add(distance);
  std::vector<Color> colors(distances.size());
  for (std::size_t i = 0; i < colors.size(); ++i) {
    if (std::isfinite(distances[i])) colors[i] = grey(1 - (1 - kFarthest) * extent.share(distances[i]));
  }
  return colors;
}

/// Each axis from the least to the largest coordinate of the picture.
std::vector<Color> of_positions(const std::vector<Vector>& positions) {
  Extent extents[3];
  for (const Vector& p : positions) {
    for (int k = 0; k < 3; ++k) extents[k].add(p[k]);
  }
  std::vector<Color> colors(positions.size());
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const Vector& p = positions[i];
    colors[i] = from_levels(extents[0].share(p.x), extents[1].share(p.y), extents[2].share(p.z));
  }
  return colors;
}

std::vector<Color> of_normals(const std::vector<Vector>& normals) {
  std::vector<Color> colors(normals.size());
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const Vector& n = normals[i];
    if (n != Vector(0)) colors[i] = from_levels((1 + double{n.x}) / 2, (1 + double{n.y}) / 2, (1 + double{n.z}) / 2);
  }
  return colors;
}

std::vector<Color> of_coordinates(const std::vector<glm::vec2>& uvs) {
  std::vector<Color> colors(uvs.size());
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const double u = uvs[i].x, v = uvs[i].y;
    colors[i] = from_levels(u - std::floor(u), v - std::floor(v), 0);
  }
  return colors;
}

/// A colour of its own for every number but the negative ones; each level is at least a quarter of white.
Color color_of_number(std::int32_t number) {
  if (number < 0) return {};
  std::uint64_t bits = (static_cast<std::uint64_t>(number) + 1) * 0x9e3779b97f4a7c15u;  // splitmix64
  bits = (bits ^ bits >> 30) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ bits >> 27) * 0x94d049bb133111ebu;
  return Color::from_24_bit((static_cast<std::uint32_t>(bits >> 40) & 0xbfbfbf) + 0x404040);
}

std::vector<Color> of_numbers(const std::vector<std::int32_t>& numbers) {
  std::vector<Color> colors(numbers.size());
  std::transform(numbers.begin(), numbers.end(), colors.begin(), color_of_number);
  return colors;
}

/// White where every light is.
std::vector<Color> of_masks(const Image& image) {
  const auto bytes = static_cast<std::size_t>(image.light_bytes());
  std::vector<Color> colors(image.lights.size() / bytes);
  for (std::size_t i = 0; i < colors.size(); ++i) {
    int lit = 0;
    for (std::size_t k = 0; k < bytes; ++k) lit += std::popcount(image.lights[i * bytes + k]);
    colors[i] = grey(double(lit) / image.light_count);
  }
  return colors;
}

/// White where no light is.
std::vector<Color> of_counts(const Image& image) {
  std::vector<Color> colors(image.shadows.size());
  const int most = std::max(1, image.light_count);
  for (std::size_t i = 0; i < colors.size(); ++i) colors[i] = grey(double(image.shadows[i]) / most);
  return colors;
}

std::vector<Color> colors_of(const Image& image, Plane plane) {
  switch (plane) {
    case Plane::Id:
      return of_numbers(image.ids);
    case Plane::Depth:
      return of_distances(image.depths);
    case Plane::Z:
      return of_distances(image.zs);
    case Plane::Position:
      return of_positions(image.positions);
    case Plane::Normal:
      return of_normals(image.normals);
    case Plane::FaceNormal:
      return of_normals(image.face_normals);
    case Plane::Albedo:
      return image.albedos;
    case Plane::Uv:
      return of_coordinates(image.uvs);
    case Plane::Object:
      return of_numbers(image.objects);
    case Plane::Material:
      return of_numbers(image.materials);
    case Plane::Lights:
      return of_masks(image);
    case Plane::Shadows:
      return of_counts(image);
  }
  throw Error("no such plane");
}

}  // namespace

Image plane_picture(const Image& image, Plane plane) {
  plane_view(image, plane);  // throws if there is none
  Image picture;
  picture.width = image.width;
  picture.height = image.height;
  picture.pixels = colors_of(image, plane);
  return picture;
}

}  // namespace facemap
