#pragma once

#include <facemap/projection.h>
#include <facemap/vector.h>

#include <memory>
#include <optional>
#include <span>

namespace facemap {

class LensModel;

enum class LensKind {
  Surface,          ///< the paper's fisheye: Projection of the same name
  Plane,            ///< perspective: Projection of the same name
  Equirectangular,  ///< a panorama of all directions: longitude across, latitude down
  CubeMap,          ///< six square pictures of 90 degrees
  OpenCVPinhole,    ///< a camera matrix with radial, rational and tangential distortion
  OpenCVFisheye,    ///< a camera matrix with the distortion of cv::fisheye (Kannala and Brandt)
};

/// Where the faces of a cube map lie in its picture. They come in OpenGL's order, +X -X +Y -Y +Z -Z, row by row, and
/// each is turned as OpenGL has it. Of a Lens's local axes that is right, left, up, down, ahead, behind; the faces
/// around stand upright, the top of the upper one is behind, the top of the lower one ahead.
enum class CubeLayout {
  Grid3x2,    ///< three faces across, two down
  Row6x1,     ///< six across
  Column1x6,  ///< six down
};

/// OpenCV's camera matrix without skew, in pixels: u = fx x + cx, v = fy y + cy with x to the right and y downwards.
/// The centre of the upper left pixel is (0, 0), as in OpenCV; the Lens gives it our (0.5, 0.5).
struct CameraMatrix {
  double fx = 0, fy = 0, cx = 0, cy = 0;
};

/// The distortion of cv::projectPoints, by the names in its documentation. No thin prism, no tilted sensor.
struct PinholeDistortion {
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0, k4 = 0, k5 = 0, k6 = 0;

  /// From OpenCV's vector of 0, 4, 5, 8, 12 or 14 coefficients: k1, k2, p1, p2, k3, k4, k5, k6, then thin prism and
  /// tilt. Throws Error for another number of them, and if one of those from the ninth on is not 0.
  static PinholeDistortion from_opencv(std::span<const double> coefficients);
};

/// The distortion of cv::fisheye: theta_d = theta (1 + k1 theta^2 + k2 theta^4 + k3 theta^6 + k4 theta^8).
struct FisheyeDistortion {
  double k1 = 0, k2 = 0, k3 = 0, k4 = 0;

  /// From OpenCV's vector of 0 or 4 coefficients. Throws Error for another number.
  static FisheyeDistortion from_opencv(std::span<const double> coefficients);
};

/// One way to see from a point: which local direction (x right, y up, z along the sight) each place of a picture
/// shows, and back. Places are map points: (0, 0) is the picture's upper left corner, y goes down.
///
/// A value: copies are cheap and immutable, and may be used by several threads together. Results have the same bits
/// on every machine. docs/cameras.md has each formula and derives the bounds.
class Lens {
 public:
  /// As Projection: fields in radians, the full angle. Throw Error if a field or a size is out of range.
  static Lens surface(double field_angle, int width, int height);
  static Lens plane(double field_angle, int width, int height);

  /// All directions; twice as wide as high has square pixels. The sight is in the middle, right of it is to the right.
  static Lens equirectangular(int width, int height);

  /// All directions. `face_size` pixels a side of a face; no side of the picture above 32768.
  static Lens cube_map(CubeLayout layout, int face_size);

  /// Throw Error, naming the field, for focal lengths outside of 2^-20..2^30 pixels, a principal point beyond 2^18
  /// pixels, a coefficient beyond 2^20, what is not finite, and sizes not in 1..32768.
  static Lens opencv_pinhole(const CameraMatrix& matrix, const PinholeDistortion& distortion, int width, int height);
  static Lens opencv_fisheye(const CameraMatrix& matrix, const FisheyeDistortion& distortion, int width, int height);

  /// The lens of a map's projection, its own kind.
  Lens(const Projection& projection);

  // Copies alone, so that there is never an empty Lens; a copy shares what it holds.
  Lens(const Lens&) = default;
  Lens& operator=(const Lens&) = default;

  LensKind kind() const noexcept;
  int width() const noexcept;   ///< pixels
  int height() const noexcept;  ///< pixels

  /// What a surface or plane lens is made of; null for the others.
  const Projection* projection() const noexcept;

  /// Unit local direction that a place shows. None beyond the lens's field, and for panoramas and cubes none outside of
  /// the picture; the others go on around it, to 2^30 pixels.
  std::optional<DVector> direction(const MapPoint& place) const noexcept;

  /// Place that shows a local direction of any length; it may lie outside of the picture, within 2^30 pixels. None for
  /// the zero vector, for what is not finite and beyond the field. Panoramas and cubes show each direction within
  /// 0 <= x < width, 0 <= y < height; where several places show one direction (seams, poles), it is one of them.
  std::optional<MapPoint> map_point(const DVector& local) const noexcept;

  /// The field's end: no direction farther than this from the sight has a place, each nearer one has (radians).
  double largest_angle() const noexcept;

  /// The picture falls into pieces of this size, of which neighbours need not show neighbouring directions: a cube's
  /// faces. Of other lenses it is the picture.
  int piece_width() const noexcept;
  int piece_height() const noexcept;

  /// Two places of the picture in the box low..high, both with a direction and s pixels apart, show directions at most
  /// s times this apart (radians a pixel). The box must lie within one piece.
  double pixel_angle(const MapPoint& low, const MapPoint& high) const noexcept;

  /// Of every box.
  double pixel_angle() const noexcept;

  /// Radians: a computed direction of a place in the picture is at most this far from the exact one, and the computed
  /// place of a direction, if within the picture, is the exact one of a direction at most this far away; but for
  /// kPlaceError.
  double angle_error() const noexcept;

  /// Pixels by which coordinates of places are rounded on the way, besides.
  static constexpr double kPlaceError = 0x1p-32;

  /// Angular radius of a cap about the computed direction of a box's middle: it holds every direction of which the
  /// computed place lies in the box. If the middle has no direction, twice the radius serves about any other place's.
  double cap_radius(const MapPoint& low, const MapPoint& high) const noexcept;

 private:
  explicit Lens(std::shared_ptr<const LensModel> model);

  std::shared_ptr<const LensModel> model_;  // never null
};

}  // namespace facemap
