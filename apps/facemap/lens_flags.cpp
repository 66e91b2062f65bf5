#include "lens_flags.h"

#include <facemap/error.h>

#include <algorithm>
#include <cmath>

#include "usage_error.h"

namespace facemap::program {
namespace {

const std::vector<std::string> kNames = {"surface", "plane",  "orthographic",  "equirect",
                                         "cube",    "opencv", "opencv-fisheye"};
const std::vector<std::string> kLayouts = {"3x2", "6x1", "1x6"};

constexpr int kFaceSide = 512;  // pixels, of a cube map whose size is not given

std::string flag_of(const WantedLens& lens) {
  return lens.name ? "--lens " + kNames[static_cast<std::size_t>(*lens.name)] : "--lens surface";
}

CameraMatrix parse_matrix(const std::string& text) {
  const std::vector<double> n = parse_numbers(text);
  if (n.size() != 4) throw UsageError("'" + text + "' is not four numbers fx,fy,cx,cy");
  return {n[0], n[1], n[2], n[3]};
}

// R must turn and no more, to what six digits leave of it.
void check_rotation(const OpenCVPose& pose) {
  constexpr double kLargestError = 1e-5;  // SpaceVector::kOrthonormalTolerance
  const auto row = [&](std::size_t i) { return DVector(pose[i][0], pose[i][1], pose[i][2]); };
  const DVector x = row(0), y = row(1), z = row(2);
  double error = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double product = row(i).x * row(k).x + row(i).y * row(k).y + row(i).z * row(k).z;
      error = std::max(error, std::fabs(product - (i == k ? 1 : 0)));
    }
  }
  const double determinant =
      x.x * (y.y * z.z - y.z * z.y) - x.y * (y.x * z.z - y.z * z.x) + x.z * (y.x * z.y - y.y * z.x);
  if (!(error <= kLargestError) || !(determinant > 0)) {
    throw UsageError("the first three columns are no rotation: rows of length 1, square to each other, unmirrored");
  }
}

OpenCVPose parse_pose(const std::string& text) {
  const std::vector<double> n = parse_numbers(text);
  if (n.size() != 12) throw UsageError("'" + text + "' is not twelve numbers: R and t, row by row");
  OpenCVPose pose;
  for (std::size_t i = 0; i < 12; ++i) pose[i / 4][i % 4] = n[i];
  check_rotation(pose);
  return pose;
}

void refuse_unless(bool goes, bool is_given, const std::string& flag, const std::string& what, const WantedLens& lens) {
  if (is_given && !goes) throw UsageError(flag + " is for " + what + ", not for " + flag_of(lens));
}

int columns_of(CubeLayout layout) { return layout == CubeLayout::Grid3x2 ? 3 : layout == CubeLayout::Row6x1 ? 6 : 1; }

Lens cube(const WantedLens& lens, const Size& size) {
  const CubeLayout layout = lens.layout.value_or(CubeLayout::Grid3x2);
  const int columns = columns_of(layout), rows = 6 / columns, side = size.width / columns;
  if (side < 1 || side * columns != size.width || side * rows != size.height) {
    const Size good = made_up_size(lens);
    throw UsageError("--size: a cube map of " + kLayouts[static_cast<std::size_t>(layout)] +
                     " faces needs a picture as " + std::to_string(good.width) + "x" + std::to_string(good.height));
  }
  return Lens::cube_map(layout, side);
}

/// What a calibrated camera cannot be is told with its flags.
template <typename Make>
Lens opencv(const WantedLens& lens, const Make& make) {
  try {
    return make();
  } catch (const Error& error) {
    throw UsageError(std::string(lens.distortion ? "--camera-matrix, --distortion: " : "--camera-matrix: ") +
                     error.what());
  }
}

}  // namespace

std::vector<Option> lens_options(WantedLens& lens) {
  return {
      {"--lens", "KIND", "surface",
       "surface and plane: as --projection; orthographic; equirect: a panorama of all directions; cube: a cube map; "
       "opencv, opencv-fisheye: a calibrated camera (docs/cameras.md)",
       [&lens](const std::string& text) { lens.name = static_cast<LensName>(parse_choice(text, kNames)); }, false,
       kNames},
      {"--cube-layout", "LAYOUT", "3x2",
       "how a cube map's faces (right, left, up, down, ahead, behind) lie in the picture",
       [&lens](const std::string& text) { lens.layout = static_cast<CubeLayout>(parse_choice(text, kLayouts)); }, false,
       kLayouts},
      {"--camera-matrix", "FX,FY,CX,CY", "", "OpenCV's camera matrix, in pixels",
       [&lens](const std::string& text) { lens.matrix = parse_matrix(text); }},
      {"--distortion", "K1,K2,...", "none",
       "OpenCV's distortion coefficients: k1,k2,p1,p2,k3... of a pinhole, k1,k2,k3,k4 of a fisheye",
       [&lens](const std::string& text) { lens.distortion = parse_numbers(text); }},
      {"--opencv-pose", "R|T", "",
       "where the camera stands, as OpenCV has it: the twelve numbers of R|t row by row, camera = R world + t, with x "
       "to the right, y down, z ahead; in place of --camera, --look-at and --up",
       [&lens](const std::string& text) { lens.pose = parse_pose(text); }},
      {"--ortho-height", "LENGTH", "made up", "world units that an orthographic picture shows from bottom to top",
       [&lens](const std::string& text) { lens.height = parse_above_0(text); }},
  };
}

void check_height(const WantedLens& lens) {
  refuse_unless(lens.is(LensName::Orthographic), lens.height.has_value(), "--ortho-height", "--lens orthographic",
                lens);
}

void check(const WantedLens& lens) {
  const bool is_opencv = lens.is(LensName::OpenCV) || lens.is(LensName::OpenCVFisheye);
  refuse_unless(lens.is(LensName::Cube), lens.layout.has_value(), "--cube-layout", "--lens cube", lens);
  refuse_unless(is_opencv, lens.matrix.has_value(), "--camera-matrix", "--lens opencv and opencv-fisheye", lens);
  refuse_unless(is_opencv, lens.distortion.has_value(), "--distortion", "--lens opencv and opencv-fisheye", lens);
  if (lens.name) check_height(lens);  // else a camera of the file may name it
  if (is_opencv && !lens.matrix) throw UsageError(flag_of(lens) + " needs --camera-matrix fx,fy,cx,cy");
}

Size made_up_size(const WantedLens& lens) {
  if (lens.is(LensName::Equirect)) return {2048, 1024};
  if (!lens.is(LensName::Cube)) return {};
  const int columns = columns_of(lens.layout.value_or(CubeLayout::Grid3x2));
  return {columns * kFaceSide, 6 / columns * kFaceSide};
}

void set_lens(const WantedLens& lens, const Size& size, View& view) {
  const std::vector<double> distortion = lens.distortion.value_or(std::vector<double>());
  switch (lens.name.value_or(view.projection == ProjectionKind::Plane ? LensName::Plane : LensName::Surface)) {
    case LensName::Surface:
      view.projection = ProjectionKind::Surface;
      return;
    case LensName::Plane:
      view.projection = ProjectionKind::Plane;
      return;
    case LensName::Orthographic:
      view.is_parallel = true;
      return;
    case LensName::Equirect:
      view.lens = Lens::equirectangular(size.width, size.height);
      return;
    case LensName::Cube:
      view.lens = cube(lens, size);
      return;
    case LensName::OpenCV:
      view.lens = opencv(lens, [&] {
        return Lens::opencv_pinhole(*lens.matrix, PinholeDistortion::from_opencv(distortion), size.width, size.height);
      });
      return;
    case LensName::OpenCVFisheye:
      view.lens = opencv(lens, [&] {
        return Lens::opencv_fisheye(*lens.matrix, FisheyeDistortion::from_opencv(distortion), size.width, size.height);
      });
      return;
  }
}

}  // namespace facemap::program
