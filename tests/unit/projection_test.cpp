#include <facemap/error.h>
#include <facemap/projection.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "math/elementary.h"
#include "support/random.h"

namespace {

using facemap::DVector;
using facemap::Error;
using facemap::MapPoint;
using facemap::Projection;
using facemap::ProjectionKind;
using facemap::elementary::kPi;

constexpr double kDegree = kPi / 180;

// A map point's error in texels: Projection::kMapError over the angle of a texel, along the radius; and as much by
// rounding of coordinates up to 2^15 texels.
double map_tolerance(const Projection& p) { return 0x1p-45 / p.texel_angle() + 0x1p-37; }

double angle_between(const DVector& a, const DVector& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

struct Setting {
  double field_deg;
  int width, height;
};

void PrintTo(const Setting& s, std::ostream* out) { *out << s.field_deg << " deg " << s.width << "x" << s.height; }

class SurfaceProjection : public testing::TestWithParam<Setting> {
 protected:
  Projection projection_{ProjectionKind::Surface, GetParam().field_deg* kDegree, GetParam().width, GetParam().height};
  double half_width_ = GetParam().width * 0.5, half_height_ = GetParam().height * 0.5;
  double radius_ = std::min(half_width_, half_height_);
};

TEST_P(SurfaceProjection, DistanceFromTheCentreIsProportionalToTheAngle) {
  // Wang 2022, eq. (14), in all quadrants.
  const double theta = GetParam().field_deg * kDegree;
  for (int i = 0; i < 720; ++i) {
    const double around = i * 0.5 * kDegree;
    for (const double beta : {0.01, 0.3, 1.0, kPi / 2, 2.0, 3.0}) {
      const DVector local(std::sin(beta) * std::cos(around), std::sin(beta) * std::sin(around), std::cos(beta));
      const MapPoint p = projection_.map_from_local(local * 7.5);
      const double t = 2 * beta / theta * radius_;
      EXPECT_NEAR(p.x, half_width_ + t * std::cos(around), 0x1p-36 * (1 + t)) << beta << ' ' << around;
      EXPECT_NEAR(p.y, half_height_ - t * std::sin(around), 0x1p-36 * (1 + t)) << beta << ' ' << around;
    }
  }
}

TEST_P(SurfaceProjection, MapPointsComeBack) {
  // Wang 2022, eq. (17) to (22), then eq. (13) to (16): every texel centre, both axes, the centre itself.
  const Projection& p = projection_;
  const double tolerance = map_tolerance(p);
  const double rim = kPi / p.texel_angle();
  int tested = 0;
  for (double y = 0; y <= p.height(); y += 0.5) {
    for (double x = 0; x <= p.width(); x += 0.5) {
      const MapPoint point(x, y);
      const double r = std::hypot(x - half_width_, y - half_height_);
      if (r > rim - 0.01) continue;
      ASSERT_TRUE(p.has_direction(point));
      const DVector local = p.local_from_map(point);
      EXPECT_NEAR(glm::length(local), 1, 0x1p-48);
      const MapPoint again = p.map_from_local(local);
      // Around the axis an error e of the direction turns a point near the rim by e r / sin(beta).
      const double swing = std::max(1.0, r * p.texel_angle() / std::fabs(std::sin(r * p.texel_angle()) + 1e-300));
      EXPECT_LE(std::hypot(again.x - x, again.y - y), tolerance * (r == 0 ? 1 : swing)) << x << ' ' << y;
      ++tested;
    }
  }
  EXPECT_GT(tested, 1000);
}

TEST_P(SurfaceProjection, DirectionsComeBack) {
  Random random(21);
  for (int i = 0; i < 20000; ++i) {
    const DVector d = random.direction();
    const MapPoint p = projection_.map_from_local(d * random.between(1e-3, 1e3));
    ASSERT_TRUE(projection_.has_direction(p));
    EXPECT_LE(angle_between(projection_.local_from_map(p), d), Projection::kMapError);
  }
}

TEST_P(SurfaceProjection, KeepsItsBoundNearTheAxisAndNearTheAntipode) {
  for (int i = 0; i < 360; ++i) {
    const double around = i * kDegree + 0.001;
    for (double off = 1e-15; off < 1; off *= 7) {
      for (const double z : {1.0, -1.0}) {
        const DVector d = glm::normalize(DVector(off * std::cos(around), off * std::sin(around), z));
        const MapPoint p = projection_.map_from_local(d);
        if (!projection_.has_direction(p)) {  // rounded past the rim, by no more than the map's error
          const double beta = std::hypot(p.x - half_width_, p.y - half_height_) * projection_.texel_angle();
          EXPECT_LE(beta, kPi + Projection::kMapError);
          continue;
        }
        EXPECT_LE(angle_between(projection_.local_from_map(p), d), Projection::kMapError) << off << ' ' << z;
      }
    }
  }
}

TEST_P(SurfaceProjection, AxisIsTheCentreAndTheAntipodeIsOnTheRim) {
  const MapPoint axis = projection_.map_from_local({0, 0, 5});
  EXPECT_EQ(axis, MapPoint(half_width_, half_height_));
  EXPECT_EQ(projection_.local_from_map(axis), DVector(0, 0, 1));
  const MapPoint antipode = projection_.map_from_local({0, 0, -5});
  const double t = std::hypot(antipode.x - half_width_, antipode.y - half_height_);
  EXPECT_NEAR(t, kPi / projection_.texel_angle(), map_tolerance(projection_));
}

TEST_P(SurfaceProjection, RightIsRightAndUpIsUp) {
  const MapPoint right = projection_.map_from_local({1, 0, 2}), left = projection_.map_from_local({-1, 0, 2});
  const MapPoint up = projection_.map_from_local({0, 1, 2}), down = projection_.map_from_local({0, -1, 2});
  EXPECT_GT(right.x, half_width_);
  EXPECT_LT(left.x, half_width_);
  EXPECT_LT(up.y, half_height_);
  EXPECT_GT(down.y, half_height_);
  // As printed, eq. (21) has the positive root alone: the left half came back mirrored.
  EXPECT_LT(projection_.local_from_map(left).x, 0);
  EXPECT_LT(projection_.local_from_map({half_width_, half_height_ + 1}).y, 0);
}

TEST_P(SurfaceProjection, HasNoDirectionBeyondTheAntipode) {
  const double rim = kPi / projection_.texel_angle();
  EXPECT_TRUE(projection_.has_direction({half_width_ + rim * 0.999, half_height_}));
  EXPECT_FALSE(projection_.has_direction({half_width_ + rim * 1.001, half_height_}));
  EXPECT_FALSE(projection_.is_mapped(DVector(0)));
  EXPECT_TRUE(projection_.is_mapped(DVector(0, 0, -1)));
}

TEST_P(SurfaceProjection, NoTexelIsWiderThanATexelAtTheCentre) {
  Random random(22);
  const double rim = kPi / projection_.texel_angle();
  for (int i = 0; i < 20000; ++i) {
    const double r = rim * std::sqrt(random.unit()) * 0.999, around = random.between(-kPi, kPi);
    const MapPoint a(half_width_ + r * std::cos(around), half_height_ + r * std::sin(around));
    const MapPoint b(a.x + random.between(-0.5, 0.5), a.y + random.between(-0.5, 0.5));
    if (!projection_.has_direction(b)) continue;
    const double angle = angle_between(projection_.local_from_map(a), projection_.local_from_map(b));
    const double distance = std::hypot(a.x - b.x, a.y - b.y);
    EXPECT_LE(angle, distance * projection_.texel_angle() + Projection::kMapError);
  }
}

INSTANTIATE_TEST_SUITE_P(Fields, SurfaceProjection,
                         testing::Values(Setting{50, 64, 64}, Setting{90, 64, 64}, Setting{120, 65, 65},
                                         Setting{170, 96, 64}, Setting{180, 64, 96}, Setting{360, 64, 64},
                                         Setting{360, 65, 63}));

class PlaneProjection : public testing::TestWithParam<Setting> {
 protected:
  Projection projection_{ProjectionKind::Plane, GetParam().field_deg* kDegree, GetParam().width, GetParam().height};
};

TEST_P(PlaneProjection, FieldAngleSpansTheHeight) {
  const double half = GetParam().field_deg * kDegree / 2;
  const MapPoint top = projection_.map_from_local({0, std::sin(half), std::cos(half)});
  EXPECT_NEAR(top.x, GetParam().width * 0.5, 1e-9);
  EXPECT_NEAR(top.y, 0, 0x1p-36 * GetParam().height);
}

TEST_P(PlaneProjection, MapPointsAndDirectionsComeBack) {
  const Projection& p = projection_;
  for (double y = 0; y <= p.height(); y += 0.5) {
    for (double x = 0; x <= p.width(); x += 0.5) {
      const DVector local = p.local_from_map({x, y});
      EXPECT_NEAR(glm::length(local), 1, 0x1p-48);
      EXPECT_GT(local.z, 0);
      const MapPoint again = p.map_from_local(local * 3.0);
      EXPECT_LE(std::hypot(again.x - x, again.y - y), 0x1p-40 * p.width()) << x << ' ' << y;
      EXPECT_LE(angle_between(p.local_from_map(again), local), Projection::kMapError);
    }
  }
}

TEST_P(PlaneProjection, StraightLinesStayStraight) {
  const DVector a(-0.3, 0.2, 1), b(0.4, -0.1, 3);
  const MapPoint pa = projection_.map_from_local(a), pb = projection_.map_from_local(b);
  for (double s = 0; s <= 1; s += 0.125) {
    const MapPoint p = projection_.map_from_local(a + s * (b - a));
    const double area = (p.x - pa.x) * (pb.y - pa.y) - (p.y - pa.y) * (pb.x - pa.x);
    EXPECT_NEAR(area, 0, 1e-9 * (1 + std::fabs(pb.x - pa.x)) * (1 + std::fabs(pb.y - pa.y)));
  }
}

TEST_P(PlaneProjection, MapsWhatIsInFrontAlone) {
  EXPECT_TRUE(projection_.is_mapped({100, 0, 1e-9}));
  EXPECT_FALSE(projection_.is_mapped({1, 0, 0}));
  EXPECT_FALSE(projection_.is_mapped({0, 0, -1}));
}

TEST_P(PlaneProjection, NoTexelIsWiderThanATexelAtTheCentre) {
  Random random(23);
  for (int i = 0; i < 5000; ++i) {
    const MapPoint a(random.between(0.0, double(GetParam().width)), random.between(0.0, double(GetParam().height)));
    const MapPoint b(a.x + random.between(-0.5, 0.5), a.y + random.between(-0.5, 0.5));
    const double angle = angle_between(projection_.local_from_map(a), projection_.local_from_map(b));
    EXPECT_LE(angle, std::hypot(a.x - b.x, a.y - b.y) * projection_.texel_angle() + Projection::kMapError);
  }
}

INSTANTIATE_TEST_SUITE_P(Fields, PlaneProjection,
                         testing::Values(Setting{50, 64, 64}, Setting{90, 96, 64}, Setting{120, 64, 96},
                                         Setting{170, 64, 64}));

TEST(Projection, RefusesFieldsAndSizesOutOfRange) {
  for (const double field : {0.0, -1.0, 2 * kPi * (1 + 1e-15), std::nan("")}) {
    EXPECT_THROW(Projection(ProjectionKind::Surface, field, 8, 8), Error) << field;
  }
  for (const double field : {0.0, -1.0, kPi, std::nan("")}) {
    EXPECT_THROW(Projection(ProjectionKind::Plane, field, 8, 8), Error) << field;
  }
  for (const int size : {0, -1, 32769}) {
    EXPECT_THROW(Projection(ProjectionKind::Surface, 1, size, 8), Error) << size;
    EXPECT_THROW(Projection(ProjectionKind::Plane, 1, 8, size), Error) << size;
  }
  EXPECT_NO_THROW(Projection(ProjectionKind::Surface, 2 * kPi, 32768, 1));
}

TEST(Projection, SurfaceAndPlaneAgreeNearTheAxis) {
  const Projection surface(ProjectionKind::Surface, 1e-3, 64, 64), plane(ProjectionKind::Plane, 1e-3, 64, 64);
  const DVector local(3e-4, -2e-4, 1);
  const MapPoint a = surface.map_from_local(local), b = plane.map_from_local(local);
  EXPECT_NEAR(a.x, b.x, 1e-5);  // texels: tan(x) - x is x^3/3, 1e-11 rad of texels of 1.6e-5 rad
  EXPECT_NEAR(a.y, b.y, 1e-5);
}

}  // namespace
