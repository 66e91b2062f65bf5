#include "render/planes.h"

#include <bit>
#include <limits>
#include <memory>

#include "map/face_planes.h"
#include "math/dvector.h"
#include "math/exact_sign.h"
#include "picture/ray_table.h"
#include "render/shade.h"
#include "render/shade_batch.h"
#include "scene/surface_coordinates.h"

namespace facemap {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t kLeastPixels = 16 * simd::kSeenBatch;  // worth a task of their own

constexpr PlaneSet kOfPoints = {Plane::Depth, Plane::Z, Plane::Position};
constexpr PlaneSet kOfFaces = {Plane::FaceNormal, Plane::Object, Plane::Material};
constexpr PlaneSet kOfSurfaces = {Plane::Normal, Plane::Albedo, Plane::Uv};

/// Makes room for the planes that are wanted, with what stands where no face is seen.
void make_room(PlaneSet wanted, Image& image) {
  const std::size_t pixels = image.ids.size();
  if (wanted.has(Plane::Depth)) image.depths.assign(pixels, kInfinity);
  if (wanted.has(Plane::Z)) image.zs.assign(pixels, kInfinity);
  if (wanted.has(Plane::Position)) image.positions.assign(pixels, Vector(kNaN));
  if (wanted.has(Plane::Normal)) image.normals.assign(pixels, Vector(0));
  if (wanted.has(Plane::FaceNormal)) image.face_normals.assign(pixels, Vector(0));
  if (wanted.has(Plane::Albedo)) image.albedos.assign(pixels, Color{});
  if (wanted.has(Plane::Uv)) image.uvs.assign(pixels, glm::vec2(kNaN));
  if (wanted.has(Plane::Object)) image.objects.assign(pixels, -1);
  if (wanted.has(Plane::Material)) image.materials.assign(pixels, -1);
  if (wanted.has(Plane::Shadows)) image.shadows.assign(pixels, -1);
}

/// The ray of a pixel's centre.
Eye::Ray ray_of(const PlaneSource& source, std::size_t pixel, const Image& image) {
  const auto columns = static_cast<std::size_t>(image.width);
  const int column = static_cast<int>(pixel % columns), row = static_cast<int>(pixel / columns);
  if (source.eye != nullptr) return source.eye->ray(source.centres.map_point(column, row));
  return {source.centres.frame.position(), source.centres.direction(column, row)};
}

/// The point that a pixel sees: the ray's parameter is that of the rational point, rounded.
void put_point(const PlaneSource& source, std::size_t pixel, Image& image) {
  const auto [K, d] = ray_of(source, pixel, image);
  const double start = source.eye != nullptr ? source.eye->start({K, d}) : 0;
  const Triangle triangle = triangle_of(source.scene, static_cast<std::uint32_t>(image.ids[pixel]));
  const TruePoint point{K, d, triangle, side(triangle, K)};
  const double t = sharp_ray_parameter(point, ray_parameter(point));
  const DVector ray(d);
  if (!image.depths.empty()) image.depths[pixel] = static_cast<float>(start + t * length(ray));
  if (!image.zs.empty()) image.zs[pixel] = static_cast<float>(start + t * dot(ray, source.centres.frame.axis_z()));
  if (!image.positions.empty()) image.positions[pixel] = Vector(DVector(K) + ray * t);
}

std::uint32_t material_of(const Mesh& mesh, std::size_t face) {
  return mesh.triangle_materials.empty() ? kNoIndex : mesh.triangle_materials[face];
}

std::int32_t signed_index(std::uint32_t index) { return index == kNoIndex ? -1 : static_cast<std::int32_t>(index); }

void put_face(const PlaneSource& source, std::size_t pixel, Image& image) {
  const Scene& scene = source.scene;
  const auto face = static_cast<std::size_t>(image.ids[pixel]);
  if (!image.objects.empty()) image.objects[pixel] = signed_index(scene.object_of(face));
  if (!image.materials.empty()) image.materials[pixel] = signed_index(material_of(scene.mesh(), face));
  if (image.face_normals.empty()) return;
  const Triangle triangle = triangle_of(scene, static_cast<std::uint32_t>(face));
  // As Shader has it: a face of which the camera is in front has its normal there.
  const double turn = side(triangle, ray_of(source, pixel, image).origin) < 0 ? 1 : -1;
  image.face_normals[pixel] = Vector(normalized(corners_of(scene.mesh(), face).n) * turn);
}

void put_shadows(std::size_t pixel, Image& image) {
  const auto bytes = static_cast<std::size_t>(image.light_bytes());
  int lit = 0;
  for (std::size_t k = 0; k < bytes; ++k) lit += std::popcount(image.lights[pixel * bytes + k]);
  image.shadows[pixel] = image.light_count - lit;
}

void put_surface(const Mesh& mesh, const ShadedSurface& surface, Image& image) {
  const std::size_t pixel = surface.sample;
  const DVector& albedo = surface.look.albedo;
  if (!image.normals.empty()) image.normals[pixel] = Vector(surface.look.normal);
  if (!image.albedos.empty()) image.albedos[pixel] = Color{float(albedo.x), float(albedo.y), float(albedo.z)};
  if (image.uvs.empty() || !has_texture_coordinates(mesh, surface.seen.face)) return;
  image.uvs[pixel] = glm::vec2(weighted(texture_corners_of(mesh, surface.seen.face).uv, surface.seen.weights));
}

/// Calls task(first pixel, one past the last, worker), by several threads.
template <class Task>
void for_each_range(const PlaneSource& source, const Image& image, const Task& task) {
  for_ranges(source.executor, image.ids.size(), kLeastPixels, task);
}

void fill_faces(const PlaneSource& source, PlaneSet wanted, Image& image) {
  const bool points = wanted.has_any(kOfPoints), faces = wanted.has_any(kOfFaces), shadows = wanted.has(Plane::Shadows);
  for_each_range(source, image, [&](std::size_t first, std::size_t end, int) {
    for (std::size_t pixel = first; pixel < end; ++pixel) {
      if (image.ids[pixel] == kNoFace) continue;
      if (points) put_point(source, pixel, image);
      if (faces) put_face(source, pixel, image);
      if (shadows) put_shadows(pixel, image);
    }
  });
}

/// The next pixels from `first` on that see a face, at most a batch. Returns the first that was not looked at.
struct SeenPixels {
  std::uint32_t samples[simd::kSeenBatch], faces[simd::kSeenBatch];
  std::size_t count = 0;

  std::size_t take(const Image& image, std::size_t first, std::size_t end) {
    for (count = 0; first < end && count < simd::kSeenBatch; ++first) {
      if (image.ids[first] == kNoFace) continue;
      samples[count] = static_cast<std::uint32_t>(first);
      faces[count++] = static_cast<std::uint32_t>(image.ids[first]);
    }
    return first;
  }
};

/// The same one by one, for rays of their own origins.
void fill_surfaces_of(const ParallelEye& eye, const PlaneSource& source, Image& image) {
  Renderer::Options options;
  options.normals = source.is_smooth ? Renderer::Normals::Smooth : Renderer::Normals::Flat;
  const auto columns = static_cast<std::size_t>(image.width);
  for_each_range(source, image, [&](std::size_t first, std::size_t end, int) {
    Renderer::Statistics statistics;
    Shader shader(eye, {}, {}, options, statistics, source.materials);
    for (std::size_t pixel = first; pixel < end; ++pixel) {
      ShadedSurface surface{static_cast<std::uint32_t>(pixel), {}, {}};
      const MapPoint place =
          source.centres.map_point(static_cast<int>(pixel % columns), static_cast<int>(pixel / columns));
      if (shader.see(place, 1, surface.seen, surface.look)) put_surface(source.scene.mesh(), surface, image);
    }
  });
}

void fill_surfaces(const PlaneSource& source, Image& image) {
  if (source.eye != nullptr) return fill_surfaces_of(*source.eye, source, image);
  const RayTable rays(source.centres);
  for_each_range(source, image, [&](std::size_t first, std::size_t end, int) {
    const auto batch =
        std::make_unique<ShadeBatch>(source.scene, source.centres, rays, source.is_smooth, source.materials);
    SeenPixels seen;
    while (first < end) {
      first = seen.take(image, first, end);
      batch->take(seen.samples, seen.faces, seen.count);
      batch->for_each_surface([&](const ShadedSurface& surface) { put_surface(source.scene.mesh(), surface, image); });
    }
  });
}

}  // namespace

PlaneSet asked_planes(PlaneSet wanted) {
  if (wanted.empty()) return {};
  if (wanted.has(Plane::Lights) || wanted.has(Plane::Shadows)) return {Plane::Id, Plane::Lights};
  return {Plane::Id};
}

void fill_planes(const PlaneSource& source, PlaneSet wanted, Image& image) {
  if (wanted.empty()) return;
  make_room(wanted, image);
  if (wanted.has_any(kOfPoints) || wanted.has_any(kOfFaces) || wanted.has(Plane::Shadows))
    fill_faces(source, wanted, image);
  if (wanted.has_any(kOfSurfaces)) fill_surfaces(source, image);
  if (!wanted.has(Plane::Id)) image.ids = {};
  if (!wanted.has(Plane::Lights)) image.lights = {};
}

}  // namespace facemap
