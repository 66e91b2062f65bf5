#include <facemap/error.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "map/lens_model.h"
#include "math/dvector.h"

namespace facemap {
namespace {

// A face's middle and where its picture's right and lower border lie, of length 1: the table of OpenGL's
// specification ("Cube Map Texture Selection") by its columns, major axis, s and t. OpenGL's cube looks along +z with x
// to the right and y up, left-handed as our local axes are, so nothing is mirrored.
struct CubeFace {
  DVector ahead, right, down;
};

const CubeFace kFaces[6] = {
    {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},   // +X
    {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},   // -X
    {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},     // +Y
    {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},   // -Y
    {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},    // +Z
    {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}},  // -Z
};

// Of directions on an edge the first of x, y, z has it.
int face_of(const DVector& local) {
  const double x = std::fabs(local.x), y = std::fabs(local.y), z = std::fabs(local.z);
  if (x >= y && x >= z) return local.x > 0 ? 0 : 1;
  if (y >= z) return local.y > 0 ? 2 : 3;
  return local.z > 0 ? 4 : 5;
}

int columns_of(CubeLayout layout) {
  switch (layout) {
    case CubeLayout::Grid3x2:
      return 3;
    case CubeLayout::Row6x1:
      return 6;
    case CubeLayout::Column1x6:
      return 1;
  }
  throw Error("unknown layout of a cube map");
}

class CubeLens final : public LensModel {
 public:
  CubeLens(int columns, int size)
      : LensModel(LensKind::CubeMap, columns * size, 6 / columns * size), columns_(columns), size_(size) {}

  std::optional<DVector> direction(const MapPoint& place) const override {
    if (!(place.x >= 0 && place.x <= width() && place.y >= 0 && place.y <= height())) return std::nullopt;
    const int column = std::min(static_cast<int>(place.x) / size_, columns_ - 1);
    const int row = std::min(static_cast<int>(place.y) / size_, 6 / columns_ - 1);
    const CubeFace& face = kFaces[row * columns_ + column];
    const double s = (place.x - column * size_) * 2 / size_ - 1;
    const double t = (place.y - row * size_) * 2 / size_ - 1;
    return (face.ahead + s * face.right + t * face.down) * (1 / std::sqrt(1 + s * s + t * t));
  }

  std::optional<MapPoint> map_point(const DVector& local) const override {
    const int number = face_of(local);
    const CubeFace& face = kFaces[number];
    const double depth = dot(local, face.ahead);
    return MapPoint(within(number % columns_, dot(local, face.right) / depth),
                    within(number / columns_, dot(local, face.down) / depth));
  }

  double largest_angle() const override { return elementary::kPi; }

  // A face is a plane projection of focal length size/2; no pixel is wider than the middle one.
  double pixel_angle(const MapPoint&, const MapPoint&) const override { return 2.0 / size_; }

  // Divisions and roots alone: below 2^-49.
  double angle_error() const override { return Projection::kMapError; }

  int piece_width() const override { return size_; }
  int piece_height() const override { return size_; }

 private:
  // The coordinate of `part` (-1 to 1) of a face in the given column or row: its far border is the next face's.
  double within(int column, double part) const {
    return std::min((column + (part + 1) * 0.5) * size_, just_below((column + 1) * size_));
  }

  int columns_, size_;
};

}  // namespace

LensModelPointer cube_lens(CubeLayout layout, int face_size) {
  const int columns = columns_of(layout);
  check_picture_size(face_size, face_size);
  check_picture_size(columns * face_size, 6 / columns * face_size);
  return std::make_shared<const CubeLens>(columns, face_size);
}

}  // namespace facemap
