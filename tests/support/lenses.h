#pragma once

#include <facemap/lens.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "support/random.h"

/// A lens of each kind and of what is odd about it, for tests that hold for all of them.
struct NamedLens {
  std::string name;
  facemap::Lens lens;
};

inline void PrintTo(const NamedLens& named, std::ostream* out) { *out << named.name; }

/// A small picture's lens of any kind but surface and plane, at most `largest` pixels a side.
inline NamedLens random_lens(Random& random, int largest) {
  using facemap::Lens;
  const int width = random.between(1, largest), height = random.between(1, largest);
  const double f = std::exp2(random.between(-1.0, 1.0)) * largest;
  const facemap::CameraMatrix matrix = {f, f * random.between(0.8, 1.2), width * random.between(-0.2, 1.2),
                                        height * random.between(0.3, 0.6)};
  switch (random.below(6)) {
    case 0:
      return {"equirectangular", Lens::equirectangular(width, height)};
    case 1: {
      const auto layout = static_cast<facemap::CubeLayout>(random.below(3));
      return {"cube", Lens::cube_map(layout, random.between(1, std::max(1, largest / 3)))};
    }
    case 2:
      return {"pinhole", Lens::opencv_pinhole(matrix, {}, width, height)};
    case 3: {
      const facemap::PinholeDistortion bent = {random.between(-0.4, 0.3), 0.05, random.between(-0.01, 0.01), 0.002};
      return {"bent pinhole", Lens::opencv_pinhole(matrix, bent, width, height)};
    }
    case 4:
      return {"fisheye", Lens::opencv_fisheye({f / 4, f / 5, matrix.cx, matrix.cy}, {}, width, height)};
    default: {
      const facemap::FisheyeDistortion bent = {random.between(-0.1, 0.05), -0.01, 0.002, 0};
      return {"bent fisheye", Lens::opencv_fisheye({f / 3, f / 3, matrix.cx, matrix.cy}, bent, width, height)};
    }
  }
}

inline std::vector<NamedLens> all_lenses() {
  using facemap::CubeLayout;
  using facemap::Lens;
  constexpr double kDegree = 0.017453292519943295;
  return {
      {"Surface50", Lens::surface(50 * kDegree, 320, 240)},
      {"Surface220", Lens::surface(220 * kDegree, 256, 256)},
      {"Surface360", Lens::surface(360 * kDegree, 200, 200)},
      {"Plane50", Lens::plane(50 * kDegree, 320, 240)},
      {"Plane170", Lens::plane(170 * kDegree, 200, 200)},
      {"Equirectangular", Lens::equirectangular(400, 200)},
      {"EquirectangularOdd", Lens::equirectangular(101, 151)},
      {"CubeGrid", Lens::cube_map(CubeLayout::Grid3x2, 64)},
      {"CubeRow", Lens::cube_map(CubeLayout::Row6x1, 33)},
      {"CubeColumn", Lens::cube_map(CubeLayout::Column1x6, 50)},
      {"PinholePlain", Lens::opencv_pinhole({500, 510, 319.5, 239.5}, {}, 640, 480)},
      {"PinholeBarrel",
       Lens::opencv_pinhole({420, 425, 330.25, 228.5}, {-0.28, 0.09, 0.0008, -0.0011, -0.012}, 640, 480)},
      {"PinholeRational",
       Lens::opencv_pinhole({380, 380, 319, 241}, {5.2, 2.1, -0.0007, 0.0004, 0.09, 5.5, 3.4, 0.45}, 640, 480)},
      {"PinholeDepthCamera",
       Lens::opencv_pinhole({305, 305, 319, 182}, {0.4628, -2.6, 0.0007, -0.0002, 1.5, 0.3443, -2.43, 1.43}, 640, 360)},
      {"PinholePincushion", Lens::opencv_pinhole({600, 590, 310, 250}, {0.15, 0.04, 0.002, 0.003, 0.01}, 640, 480)},
      {"PinholeFolded", Lens::opencv_pinhole({250, 250, 320, 240}, {-0.3, 0, 0.004, -0.003}, 640, 480)},
      {"PinholeFarOff", Lens::opencv_pinhole({1e5, 2e5, -4000, 9000}, {-0.1, 0.2, 1e-3, 1e-3}, 64, 48)},
      {"FisheyePlain", Lens::opencv_fisheye({160, 160, 319.5, 319.5}, {}, 640, 640)},
      {"Fisheye220", Lens::opencv_fisheye({285.7, 286.1, 508.2, 513.7}, {-0.012, 0.004, -0.0035, 0.0006}, 1024, 1024)},
      {"FisheyeFolded", Lens::opencv_fisheye({200, 205, 250, 255}, {-0.1, -0.01}, 512, 512)},
      {"Fisheye360", Lens::opencv_fisheye({80, 80, 255.5, 255.5}, {0.01}, 512, 512)},
  };
}
