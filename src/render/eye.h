#pragma once

#include <facemap/camera.h>
#include <facemap/lens.h>

#include <cstdint>
#include <span>

#include "material/footprint.h"

namespace facemap {

/// How a picture's places become rays, one at a time, and what these meet first.
class Eye {
 public:
  struct Ray {
    Vector origin{0}, direction{0};  ///< direction zero: none
  };

  virtual ~Eye() = default;
  virtual const Scene& scene() const = 0;
  virtual Ray ray(const MapPoint& place) const = 0;

  /// As Camera::nearest.
  virtual Camera::Hit nearest(const Ray& ray, Counters* counters) const = 0;

  /// The ray through a place and those through the places `step` pixels to the right and below (set_neighbours), as if
  /// they came from one origin. The face that it meets is `distance` directions away.
  virtual RayBundle bundle(const Ray& ray, const MapPoint& place, double step, double distance) const = 0;

  /// Whether faces_at() and cut_outs_at() know a pixel's candidates; if not they are empty.
  virtual bool has_lists() const { return true; }

  /// Candidates of a pixel besides what its rays have met, if they are listed.
  virtual std::span<const std::uint32_t> faces_at(int x, int y) const = 0;

  /// Those with holes, which are not among them.
  virtual std::span<const std::uint32_t> cut_outs_at(int /*x*/, int /*y*/) const { return {}; }

 protected:
  Eye() = default;
  Eye(const Eye&) = default;
  Eye& operator=(const Eye&) = default;
};

/// Looks from one point: through the camera's own map, or through a lens at a map that holds all that it may see.
class CentralEye final : public Eye {
 public:
  /// The camera must outlive it, and keep all directions of the lens.
  CentralEye(const Camera& camera, const Lens& lens) : camera_(camera), lens_(lens) {}
  explicit CentralEye(const Camera& camera) : CentralEye(camera, camera.projection()) {}

  const Scene& scene() const override { return camera_.scene(); }
  Ray ray(const MapPoint& place) const override;
  Camera::Hit nearest(const Ray& ray, Counters* counters) const override;
  RayBundle bundle(const Ray& ray, const MapPoint& place, double step, double distance) const override;
  bool has_lists() const override { return lens_.projection() != nullptr; }
  std::span<const std::uint32_t> faces_at(int x, int y) const override;
  std::span<const std::uint32_t> cut_outs_at(int x, int y) const override;

 private:
  const Camera& camera_;
  Lens lens_;
};

}  // namespace facemap
