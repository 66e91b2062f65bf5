#pragma once

#include <facemap/lens.h>

#include <memory>
#include <optional>

namespace facemap {

/// What a kind of lens defines; see Lens for what each function means. Lens sees to places and directions that are not
/// finite or too large before it asks.
class LensModel {
 public:
  LensModel(LensKind kind, int width, int height) : kind_(kind), width_(width), height_(height) {}
  virtual ~LensModel() = default;
  LensModel(const LensModel&) = delete;
  LensModel& operator=(const LensModel&) = delete;

  LensKind kind() const { return kind_; }
  int width() const { return width_; }
  int height() const { return height_; }

  virtual std::optional<DVector> direction(const MapPoint& place) const = 0;

  /// The largest component of `local` is within 2^-400..2^400.
  virtual std::optional<MapPoint> map_point(const DVector& local) const = 0;

  virtual double largest_angle() const = 0;
  virtual double pixel_angle(const MapPoint& low, const MapPoint& high) const = 0;
  virtual double angle_error() const = 0;
  virtual int piece_width() const { return width_; }
  virtual int piece_height() const { return height_; }
  virtual const Projection* projection() const { return nullptr; }

 private:
  LensKind kind_;
  int width_, height_;
};

using LensModelPointer = std::shared_ptr<const LensModel>;

LensModelPointer projection_lens(const Projection& projection);
LensModelPointer equirectangular_lens(int width, int height);
LensModelPointer cube_lens(CubeLayout layout, int face_size);
LensModelPointer pinhole_lens(const CameraMatrix& matrix, const PinholeDistortion& distortion, int width, int height);
LensModelPointer fisheye_lens(const CameraMatrix& matrix, const FisheyeDistortion& distortion, int width, int height);

/// Throws Error unless both sizes are in 1..32768.
void check_picture_size(int width, int height);

/// The largest double below x > 0: a relative 2^-53 is more than half a unit in the last place of what is below x.
inline double just_below(double x) { return x * (1 - 0x1p-53); }

}  // namespace facemap
