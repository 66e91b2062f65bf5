#include <facemap/error.h>
#include <facemap/raster.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "map/face_planes.h"
#include "math/clip.h"
#include "math/dvector.h"
#include "math/exact_sign.h"
#include "render/scan_lines.h"
#include "render/screen_transform.h"

namespace facemap {
namespace {

// Automatic planes, as shares of the farthest vertex's distance along the sight (no unit). The depth buffer is in
// double: at the far plane it still tells distances apart that differ by 2^-32 of themselves.
constexpr double kNearShare = 0x1p-20;
constexpr double kFarMargin = 0x1p-10;

constexpr int kMostEdgeSamples = 16;

struct Planes {
  double near, far;
};

// ---- faces on the screen --------------------------------------------------------------------------------

// Convex polygons of pixel coordinates and depths, one after the other.
struct ScreenFaces {
  std::vector<DVector> vertices;
  std::vector<std::size_t> ends;  // of each polygon in `vertices`
  std::vector<FaceId> faces;
};

DVector local_point(const SpaceVector& frame, const Vector& world) {
  return frame.local_from_world(DVector(world) - DVector(frame.position()));
}

Planes choose_planes(const Scene& scene, const SpaceVector& frame, const RasterOptions& options) {
  double farthest = 0;
  for (const std::uint32_t face : scene.kept_faces()) {
    for (const Vector& vertex : triangle_of(scene, face)) farthest = std::max(farthest, local_point(frame, vertex).z);
  }
  if (farthest == 0) farthest = 1;  // nothing in front of the camera
  const double far = options.far_plane > 0 ? options.far_plane : farthest * (1 + kFarMargin);
  const double near = options.near_plane > 0 ? options.near_plane : far * kNearShare;
  if (!(near < far)) throw Error("raster: the near plane must be nearer than the far plane");
  return {near, far};
}

ScreenFaces project_faces(const Scene& scene, const SpaceVector& frame, const glm::dmat4& MS, double near) {
  ScreenFaces screen;
  std::vector<DVector> clipped;
  for (const std::uint32_t face : scene.kept_faces()) {
    const Triangle world = triangle_of(scene, face);
    if (side(world, frame.position()) == 0) continue;  // seen edge-on
    std::array<DVector, 3> local;
    for (int i = 0; i < 3; ++i) local[i] = local_point(frame, world[i]);
    clip_at_near_plane(local, near, clipped);
    if (clipped.empty()) continue;
    for (const DVector& p : clipped) screen.vertices.push_back(screen_from_local(p, MS));
    screen.ends.push_back(screen.vertices.size());
    screen.faces.push_back(static_cast<FaceId>(face));
  }
  return screen;
}

ScreenSamples sample_faces(const ScreenFaces& screen, const PixelMask& mask, ScreenSamples samples) {
  std::size_t begin = 0;
  for (std::size_t i = 0; i < screen.ends.size(); ++i) {
    const std::span polygon(screen.vertices.data() + begin, screen.ends[i] - begin);
    fill_scan_lines(polygon, screen.faces[i], mask, samples);
    begin = screen.ends[i];
  }
  return samples;
}

// ---- colour ---------------------------------------------------------------------------------------------

// White mode, flat, without shadows.
class Shader {
 public:
  Shader(const Scene& scene, const SpaceVector& frame, const std::vector<Light>& lights)
      : scene_(scene),
        frame_(frame),
        lights_(lights.empty() ? headlight(frame) : lights),
        sides_(lights_.size() + 1, std::vector<std::int8_t>(scene.face_count(), kNotAsked)) {}

  // `local` is the seen point of `face` in camera space.
  Color radiance(FaceId face, const DVector& local) {
    const Triangle corners = triangle_of(scene_, static_cast<std::uint32_t>(face));
    const DVector a(corners[0]);
    const DVector n = cross(DVector(corners[1]) - a, DVector(corners[2]) - a);
    const DVector point = DVector(frame_.position()) + frame_.world_from_local(local);
    const int camera_side = side_of(face, corners, lights_.size(), frame_.position());
    Color sum;
    for (std::size_t i = 0; i < lights_.size(); ++i) {
      const Light& light = lights_[i];
      if (side_of(face, corners, i, light.position) != camera_side) continue;
      const DVector to_light = DVector(light.position) - point;
      const double lengths = length(n) * length(to_light);
      const double cosine = lengths > 0 ? std::fabs(dot(n, to_light)) / lengths : 0;
      sum = sum + light.color * (light.intensity * static_cast<float>(cosine));
    }
    return sum;
  }

 private:
  static constexpr std::int8_t kNotAsked = 2;

  static std::vector<Light> headlight(const SpaceVector& frame) {
    Light light;
    light.position = frame.position();
    return {light};
  }

  // On which side of the face a light is (`slot` its index) or the camera (the last slot), asked once.
  int side_of(FaceId face, const Triangle& corners, std::size_t slot, const Vector& position) {
    std::int8_t& known = sides_[slot][face];
    if (known == kNotAsked) known = static_cast<std::int8_t>(side(corners, position));
    return known;
  }

  const Scene& scene_;
  const SpaceVector& frame_;
  std::vector<Light> lights_;
  std::vector<std::vector<std::int8_t>> sides_;
};

// ---- the picture ----------------------------------------------------------------------------------------

class Raster {
 public:
  Raster(const Scene& scene, const View& view, const std::vector<Light>& lights, const RasterOptions& options)
      : options_(options),
        frame_(SpaceVector::looking_at(view.position, view.look_at, view.up)),
        projection_(ProjectionKind::Plane, view.field_angle, options.width, options.height),
        planes_(choose_planes(scene, frame_, options)),
        shader_(scene, frame_, lights) {
    const double aspect = static_cast<double>(options.width) / options.height;
    const glm::dmat4 M = perspective_matrix(view.field_angle, aspect, planes_.near, planes_.far);
    const glm::dmat4 S = screen_matrix(options.width, options.height);
    screen_ = project_faces(scene, frame_, M * S, planes_.near);
  }

  Image draw() {
    const ScreenSamples centres = sample_faces(screen_, {}, ScreenSamples(options_.width, options_.height, 0.5, 0.5));
    Image image;
    image.width = options_.width;
    image.height = options_.height;
    image.pixels.reserve(centres.faces.size());
    for (std::size_t pixel = 0; pixel < centres.faces.size(); ++pixel) {
      image.pixels.push_back(color_of(centres, pixel));
      if (options_.want_depths) image.depths.push_back(distance_of(centres, pixel));
    }
    if (options_.want_ids) image.ids = centres.faces;
    if (options_.edge_samples > 1) smooth_edges(centres, image);
    return image;
  }

 private:
  // Wang 2022, Fig. 3: only edge pixels are divided.
  void smooth_edges(const ScreenSamples& centres, Image& image) {
    const PixelMask edges = edge_pixels(centres);
    const int n = options_.edge_samples;
    const float weight = 1.0f / static_cast<float>(n * n);
    for (std::size_t pixel = 0; pixel < edges.size(); ++pixel) {
      if (edges[pixel] != 0) image.pixels[pixel] = Color{};
    }
    for (int i = 0; i < n * n; ++i) {
      const double x = (i % n + 0.5) / n, y = (i / n + 0.5) / n;
      const ScreenSamples samples = sample_faces(screen_, edges, ScreenSamples(options_.width, options_.height, x, y));
      for (std::size_t pixel = 0; pixel < edges.size(); ++pixel) {
        if (edges[pixel] != 0) image.pixels[pixel] = image.pixels[pixel] + color_of(samples, pixel) * weight;
      }
    }
  }

  static PixelMask edge_pixels(const ScreenSamples& samples) {
    PixelMask edges(samples.faces.size(), 0);
    const auto compare = [&](std::size_t a, std::size_t b) {
      if (samples.faces[a] != samples.faces[b]) edges[a] = edges[b] = 1;
    };
    for (int row = 0; row < samples.height; ++row) {
      for (int column = 0; column < samples.width; ++column) {
        const std::size_t pixel = static_cast<std::size_t>(row) * samples.width + column;
        if (column + 1 < samples.width) compare(pixel, pixel + 1);
        if (row + 1 < samples.height) compare(pixel, pixel + samples.width);
      }
    }
    return edges;
  }

  DVector direction_of(const ScreenSamples& samples, std::size_t pixel) const {
    const auto width = static_cast<std::size_t>(samples.width);
    return projection_.local_from_map(
        {static_cast<double>(pixel % width) + samples.x, static_cast<double>(pixel / width) + samples.y});
  }

  // Distance along the pixel's ray, unrounded.
  double ray_length(const ScreenSamples& samples, std::size_t pixel, const DVector& direction) const {
    return sight_distance(samples.depths[pixel], planes_.near, planes_.far) / direction.z;
  }

  float distance_of(const ScreenSamples& samples, std::size_t pixel) const {
    if (samples.faces[pixel] == kNoFace) return std::numeric_limits<float>::infinity();
    return static_cast<float>(ray_length(samples, pixel, direction_of(samples, pixel)));
  }

  Color color_of(const ScreenSamples& samples, std::size_t pixel) {
    const FaceId face = samples.faces[pixel];
    if (face == kNoFace) return options_.background;
    const DVector direction = direction_of(samples, pixel);
    return shader_.radiance(face, direction * ray_length(samples, pixel, direction));
  }

  RasterOptions options_;
  SpaceVector frame_;
  Projection projection_;
  Planes planes_;
  Shader shader_;
  ScreenFaces screen_;
};

void check(const View& view, const RasterOptions& options) {
  if (view.projection != ProjectionKind::Plane || view.lens || view.is_parallel)
    throw Error("raster: the method has the plane projection alone");
  if (options.edge_samples < 1 || options.edge_samples > kMostEdgeSamples) {
    throw Error("raster: edge_samples must be 1 to 16");
  }
  for (const double plane : {options.near_plane, options.far_plane}) {
    if (!(plane >= 0 && std::isfinite(plane)))
      throw Error("raster: near_plane and far_plane must be finite, 0 or more");
  }
}

}  // namespace

Image render_raster(const Scene& scene, const View& view, const std::vector<Light>& lights,
                    const RasterOptions& options) {
  check(view, options);
  return Raster(scene, view, lights, options).draw();
}

}  // namespace facemap
