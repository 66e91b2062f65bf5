#include <facemap/error.h>
#include <facemap/lens.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "math/elementary.h"
#include "support/random.h"

namespace {

using facemap::CameraMatrix;
using facemap::DVector;
using facemap::Error;
using facemap::FisheyeDistortion;
using facemap::Lens;
using facemap::MapPoint;
using facemap::PinholeDistortion;

constexpr double kAgreement = 1e-9;  // pixels

struct Pixel {
  long double u, v;
};

// OpenCV's documentation of calib3d, "Detailed Description", in its own frame: X right, Y down, Z ahead.
Pixel opencv_pinhole(const CameraMatrix& m, const PinholeDistortion& k, long double X, long double Y, long double Z) {
  const long double x = X / Z, y = Y / Z, r2 = x * x + y * y, r4 = r2 * r2, r6 = r4 * r2;
  const long double radial = (1 + k.k1 * r2 + k.k2 * r4 + k.k3 * r6) / (1 + k.k4 * r2 + k.k5 * r4 + k.k6 * r6);
  const long double xd = x * radial + 2 * k.p1 * x * y + k.p2 * (r2 + 2 * x * x);
  const long double yd = y * radial + k.p1 * (r2 + 2 * y * y) + 2 * k.p2 * x * y;
  return {m.fx * xd + m.cx, m.fy * yd + m.cy};
}

// The same of namespace fisheye; the angle from both arguments instead of from the quotient, for what is behind.
Pixel opencv_fisheye(const CameraMatrix& m, const FisheyeDistortion& k, long double X, long double Y, long double Z) {
  const long double r = std::sqrt(X * X + Y * Y), theta = std::atan2(r, Z), t2 = theta * theta;
  const long double theta_d = theta * (1 + k.k1 * t2 + k.k2 * t2 * t2 + k.k3 * t2 * t2 * t2 + k.k4 * t2 * t2 * t2 * t2);
  return {m.fx * theta_d / r * X + m.cx, m.fy * theta_d / r * Y + m.cy};
}

double distance(const MapPoint& place, const Pixel& pixel) {
  // The centre of the upper left pixel: (0, 0) in OpenCV, (0.5, 0.5) here.
  return static_cast<double>(std::hypot(place.x - 0.5L - pixel.u, place.y - 0.5L - pixel.v));
}

TEST(OpenCVPinhole, AgreesWithThePublishedFormula) {
  const CameraMatrix matrix{431.5, 429.25, 322.1, 236.7};
  const std::vector<PinholeDistortion> distortions = {
      {}, {-0.28, 0.09, 0.0008, -0.0011, -0.012}, {5.2, 2.1, -0.0007, 0.0004, 0.09, 5.5, 3.4, 0.45}};
  for (const PinholeDistortion& k : distortions) {
    Random random(78);
    const Lens lens = Lens::opencv_pinhole(matrix, k, 640, 480);
    for (int i = 0; i < 10000; ++i) {
      const double z = random.between(0.1, 50.0);
      const double x = z * random.between(-0.9, 0.9), y = z * random.between(-0.9, 0.9);
      const auto place = lens.map_point({x, -y, z});
      ASSERT_TRUE(place);
      EXPECT_LE(distance(*place, opencv_pinhole(matrix, k, x, y, z)), kAgreement);
    }
  }
}

TEST(OpenCVFisheye, AgreesWithThePublishedFormula) {
  const CameraMatrix matrix{285.7, 286.1, 508.2, 513.7};
  const FisheyeDistortion k{-0.012, 0.004, -0.0035, 0.0006};
  const Lens lens = Lens::opencv_fisheye(matrix, k, 1024, 1024);
  Random random(79);
  int behind = 0, tested = 0;
  while (tested < 10000) {
    const DVector d = random.direction() * random.between(0.1, 50.0);
    const auto place = lens.map_point({d.x, -d.y, d.z});
    if (!place) continue;
    EXPECT_LE(distance(*place, opencv_fisheye(matrix, k, d.x, d.y, d.z)), kAgreement);
    ++tested;
    behind += d.z < 0;
  }
  EXPECT_GT(behind, 1000);
}

TEST(OpenCVPinhole, PlacesComeBackThroughTheFormula) {
  const CameraMatrix matrix{380, 384, 319, 241};
  const PinholeDistortion k{-0.31, 0.11, 0.002, -0.003, -0.01};
  const Lens lens = Lens::opencv_pinhole(matrix, k, 640, 480);
  for (double y = 0.5; y < 480; y += 7) {
    for (double x = 0.5; x < 640; x += 7) {
      const auto d = lens.direction({x, y});
      ASSERT_TRUE(d);
      EXPECT_LE(distance({x, y}, opencv_pinhole(matrix, k, d->x, -d->y, d->z)), kAgreement);
    }
  }
}

// The exact solution near a computed one, in long double: Newton's steps with the derivative by differences.
template <class Formula>
void refine(const Formula& formula, const Pixel& target, long double& a, long double& b) {
  for (int i = 0; i < 8; ++i) {
    constexpr long double kStep = 1e-7L;
    const Pixel at = formula(a, b), along_a = formula(a + kStep, b), along_b = formula(a, b + kStep);
    const long double ua = (along_a.u - at.u) / kStep, va = (along_a.v - at.v) / kStep;
    const long double ub = (along_b.u - at.u) / kStep, vb = (along_b.v - at.v) / kStep;
    const long double du = target.u - at.u, dv = target.v - at.v, determinant = ua * vb - ub * va;
    a += (du * vb - dv * ub) / determinant;
    b += (dv * ua - du * va) / determinant;
  }
}

// What rounding of places costs besides.
double error_bound(const Lens& lens) { return lens.angle_error() + 2 * Lens::kPlaceError * lens.pixel_angle(); }

TEST(OpenCVPinhole, DirectionsKeepTheirErrorBound) {
  const CameraMatrix matrix{380, 384, 319, 241};
  const std::vector<PinholeDistortion> distortions = {
      {}, {-0.31, 0.11, 0.002, -0.003, -0.01}, {0.4628, -2.6, 0.0007, -0.0002, 1.5, 0.3443, -2.43, 1.43}};
  for (const PinholeDistortion& k : distortions) {
    const Lens lens = Lens::opencv_pinhole(matrix, k, 640, 480);
    for (double y = 0.5; y < 480; y += 13) {
      for (double x = 0.5; x < 640; x += 13) {
        const DVector d = *lens.direction({x, y});
        long double a = d.x / d.z, b = -d.y / d.z;
        const long double first_a = a, first_b = b;
        refine([&](long double s, long double t) { return opencv_pinhole(matrix, k, s, t, 1); }, {x - 0.5L, y - 0.5L},
               a, b);
        // An angle is at most the distance of its ends on the plane.
        EXPECT_LE(std::hypot(a - first_a, b - first_b), error_bound(lens)) << x << ' ' << y;
      }
    }
  }
}

TEST(OpenCVFisheye, DirectionsKeepTheirErrorBound) {
  const CameraMatrix matrix{285.7, 286.1, 508.2, 513.7};
  const FisheyeDistortion k{-0.012, 0.004, -0.0035, 0.0006};
  const Lens lens = Lens::opencv_fisheye(matrix, k, 1024, 1024);
  for (double y = 0.5; y < 1024; y += 23) {
    for (double x = 0.5; x < 1024; x += 23) {
      const auto d = lens.direction({x, y});
      ASSERT_TRUE(d);
      // Angle from the sight and angle around.
      long double theta = std::atan2(std::hypot(static_cast<long double>(d->x), d->y), static_cast<long double>(d->z));
      long double around = std::atan2(-static_cast<long double>(d->y), d->x);
      const long double first_theta = theta, first_around = around;
      refine(
          [&](long double s, long double t) {
            return opencv_fisheye(matrix, k, std::sin(s) * std::cos(t), std::sin(s) * std::sin(t), std::cos(s));
          },
          {x - 0.5L, y - 0.5L}, theta, around);
      const long double off = std::hypot(theta - first_theta, std::sin(theta) * (around - first_around));
      EXPECT_LE(off, error_bound(lens)) << x << ' ' << y;
    }
  }
}

TEST(OpenCVFisheye, RimOfTwoHundredAndTwentyDegreesIsWhereTheFormulaHasIt) {
  // Without distortion 110 degrees from the sight are 1.9199 focal lengths.
  constexpr double kRim = 110 * facemap::elementary::kPi / 180;
  const Lens lens = Lens::opencv_fisheye({256, 256, 511.5, 511.5}, {}, 1024, 1024);
  const DVector d = *lens.direction({512 + 256 * kRim, 512});
  EXPECT_NEAR(d.z, std::cos(kRim), 1e-14);
  EXPECT_NEAR(d.x, std::sin(kRim), 1e-14);
  // A point of range 10 there has the depth z = 10 cos 110 degrees, behind the camera's plane; range and z lead back.
  const double range = 10, z = range * d.z;
  EXPECT_NEAR(z, -3.4202014332566873, 1e-12);
  const MapPoint again = *lens.map_point({std::sqrt(range * range - z * z), 0, z});
  EXPECT_NEAR(again.x, 512 + 256 * kRim, 1e-10);
  EXPECT_NEAR(again.y, 512, 1e-10);
}

TEST(OpenCVPinhole, WithoutDistortionIsThePlaneProjection) {
  const double focal = 240 / std::tan(0.4);
  const Lens plane = Lens::plane(0.8, 640, 480);
  const Lens lens = Lens::opencv_pinhole({focal, focal, 319.5, 239.5}, {}, 640, 480);
  for (double x = 0.5; x < 640; x += 9) {
    const DVector a = *plane.direction({x, 100.5}), b = *lens.direction({x, 100.5});
    EXPECT_NEAR(a.x, b.x, 1e-15);
    EXPECT_NEAR(a.y, b.y, 1e-15);
  }
  EXPECT_NEAR(lens.pixel_angle(), plane.pixel_angle(), 1e-6 * plane.pixel_angle());
}

TEST(OpenCVFisheye, WithoutDistortionIsTheSurfaceProjection) {
  const Lens surface = Lens::surface(3.2, 400, 400);
  const Lens lens = Lens::opencv_fisheye({125, 125, 199.5, 199.5}, {}, 400, 400);
  for (double x = 0.5; x < 400; x += 9) {
    const DVector a = *surface.direction({x, 100.5}), b = *lens.direction({x, 100.5});
    EXPECT_NEAR(a.x, b.x, 1e-14);
    EXPECT_NEAR(a.y, b.y, 1e-14);
    EXPECT_NEAR(a.z, b.z, 1e-14);
  }
}

TEST(OpenCVFisheye, BeyondTheFoldThereIsNoDirection) {
  // theta_d = theta - 0.1 theta^3 rises to 2/3 sqrt(1/0.3) = 1.2172 at 104.6 degrees: 243.43 pixels of 256.
  const Lens lens = Lens::opencv_fisheye({200, 200, 255.5, 255.5}, {-0.1}, 512, 512);
  const double fold = std::sqrt(1 / 0.3), rim = 200 * fold * 2 / 3;
  EXPECT_NEAR(lens.largest_angle(), fold, 1e-3);
  EXPECT_TRUE(lens.direction({256 + rim - 0.001, 256}));
  EXPECT_FALSE(lens.direction({256 + rim + 0.001, 256}));
  EXPECT_FALSE(lens.direction({0.5, 0.5}));
  // Directions beyond have no place, though the formula puts them into the picture once more.
  EXPECT_TRUE(lens.map_point({std::sin(1.82), 0, std::cos(1.82)}));
  EXPECT_FALSE(lens.map_point({std::sin(1.83), 0, std::cos(1.83)}));
  EXPECT_FALSE(lens.map_point({0, 0, -1}));
}

TEST(OpenCVPinhole, BeyondTheFoldThereIsNoDirection) {
  // r - 0.3 r^3 rises to 0.7027 at r = 1.0541: 175.7 pixels.
  const Lens lens = Lens::opencv_pinhole({250, 250, 319.5, 239.5}, {-0.3}, 640, 480);
  const double fold = std::sqrt(1 / 0.9), rim = 250 * fold * 2 / 3;
  EXPECT_NEAR(lens.largest_angle(), std::atan(fold), 1e-3);
  EXPECT_TRUE(lens.direction({320, 240 - rim + 0.001}));
  EXPECT_FALSE(lens.direction({320, 240 - rim - 0.001}));
  EXPECT_TRUE(lens.map_point({fold - 0.001, 0, 1}));
  EXPECT_FALSE(lens.map_point({fold + 0.001, 0, 1}));
}

TEST(OpenCVFisheye, StraightBehindIsOnTheRim) {
  const Lens lens = Lens::opencv_fisheye({50, 50, 255.5, 255.5}, {}, 512, 512);
  EXPECT_EQ(lens.largest_angle(), facemap::elementary::kPi);
  EXPECT_NEAR(lens.map_point({0, 0, -1})->x, 256 + 50 * facemap::elementary::kPi, 1e-12);
  EXPECT_FALSE(lens.direction({256 + 50 * 3.15, 256}));
}

TEST(OpenCVLens, ReadsVectorsInOpenCVsOrder) {
  const double values[] = {1, 2, 3, 4, 5, 6, 7, 8, 0, 0, 0, 0, 0, 0};
  const auto pinhole = [&](std::size_t n) { return PinholeDistortion::from_opencv({values, n}); };
  EXPECT_EQ(pinhole(0).k1, 0);
  EXPECT_EQ(pinhole(4).p2, 4);
  EXPECT_EQ(pinhole(4).k3, 0);
  EXPECT_EQ(pinhole(5).k3, 5);
  EXPECT_EQ(pinhole(8).k6, 8);
  EXPECT_EQ(pinhole(14).p1, 3);
  for (const std::size_t n : {1u, 3u, 6u, 7u, 9u, 13u}) EXPECT_THROW(pinhole(n), Error) << n;
  std::vector<double> prism(12, 0.0);
  prism[9] = 1e-3;
  EXPECT_THROW(PinholeDistortion::from_opencv(prism), Error);
  EXPECT_EQ(FisheyeDistortion::from_opencv({values, 4}).k4, 4);
  EXPECT_EQ(FisheyeDistortion::from_opencv({}).k1, 0);
  EXPECT_THROW(FisheyeDistortion::from_opencv({values, 5}), Error);
}

TEST(OpenCVLens, RefusesMatricesAndCoefficientsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = HUGE_VAL;
  for (const double bad : {0.0, -1.0, nan, infinity, 1e-300, 1e300}) {
    EXPECT_THROW(Lens::opencv_pinhole({bad, 1, 0, 0}, {}, 8, 8), Error) << bad;
    EXPECT_THROW(Lens::opencv_fisheye({1, bad, 0, 0}, {}, 8, 8), Error) << bad;
  }
  for (const double bad : {nan, infinity, 1e7, -1e7}) {
    EXPECT_THROW(Lens::opencv_pinhole({1, 1, bad, 0}, {}, 8, 8), Error) << bad;
    EXPECT_THROW(Lens::opencv_fisheye({1, 1, 0, bad}, {}, 8, 8), Error) << bad;
    for (double PinholeDistortion::*field :
         {&PinholeDistortion::k1, &PinholeDistortion::k2, &PinholeDistortion::p1, &PinholeDistortion::p2,
          &PinholeDistortion::k3, &PinholeDistortion::k4, &PinholeDistortion::k5, &PinholeDistortion::k6}) {
      PinholeDistortion k;
      k.*field = bad;
      EXPECT_THROW(Lens::opencv_pinhole({1, 1, 0, 0}, k, 8, 8), Error) << bad;
    }
    EXPECT_THROW(Lens::opencv_fisheye({1, 1, 0, 0}, {0, 0, 0, bad}, 8, 8), Error) << bad;
  }
}

TEST(OpenCVLens, SaysWhichFieldIsWrong) {
  try {
    Lens::opencv_pinhole({500, -500, 0, 0}, {}, 8, 8);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "camera matrix: fy must be above 0");
  }
}

TEST(OpenCVLens, WildDistortionsEndAndAreOneToOne) {
  Random random(80);
  for (int i = 0; i < 400; ++i) {
    const double size = std::exp(random.between(-6.0, 12.0));
    const auto k = [&] { return random.chance(0.3) ? 0 : random.between(-size, size); };
    const Lens lens = i % 2 ? Lens::opencv_pinhole({300, 300, 320, 240},
                                                   {k(), k(), k() * 0.01, k() * 0.01, k(), k(), k(), k()}, 640, 480)
                            : Lens::opencv_fisheye({300, 300, 320, 240}, {k(), k(), k(), k()}, 640, 480);
    for (int n = 0; n < 100; ++n) {
      const MapPoint p(random.between(0.0, 640.0), random.between(0.0, 480.0));
      const auto d = lens.direction(p);
      if (!d) continue;
      const auto again = lens.map_point(*d);
      if (!again) continue;
      EXPECT_LE(std::hypot(again->x - p.x, again->y - p.y), 1e-6) << i;
    }
  }
}

}  // namespace
