#include "material/brdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "math/dvector.h"
#include "math/elementary.h"
#include "support/random.h"

namespace facemap {
namespace {

const DVector kUp(0, 0, 1);

DVector direction(double cosine, double angle) {
  const double sine = std::sqrt(1 - cosine * cosine);
  return {sine * elementary::cos(angle), sine * elementary::sin(angle), cosine};
}

// The share of light from everywhere that is sent to a view of this cosine, by the midpoint rule over the hemisphere:
// of light that comes from there, by reciprocity, the share that is sent on. Angles are dense where light is mirrored.
double albedo(const Reflection& surface, double view_cosine) {
  constexpr int kCosines = 400, kAngles = 100;
  const DVector view = direction(view_cosine, 0);
  double sum = 0;
  for (int i = 0; i < kCosines; ++i) {
    const double cosine = (i + 0.5) / kCosines;
    for (int j = 0; j < kAngles; ++j) {
      const double x = (j + 0.5) / kAngles;  // half the circle; the other is the same
      const double weight = 3 * x * x * cosine;
      sum += weight * reflected(surface, kUp, direction(cosine, elementary::kPi * (1 + x * x * x)), view).x;
    }
  }
  return 2 * sum / (kCosines * kAngles);  // pi f, and the integral of cos dw is pi
}

// What the quadrature is off by for the sharpest lobe asked here (alpha 0.09): halving its steps changes less.
constexpr double kQuadratureError = 0.002;

std::vector<Reflection> surfaces() {
  std::vector<Reflection> result;
  for (const double albedo : {0.0, 0.5, 0.9, 1.0}) {
    for (const double exponent : {0.5, 2.0, 10.0, 96.0}) {
      result.push_back(blinn_phong(DVector(albedo), DVector(1), exponent));
    }
    for (const double metal : {0.0, 0.5, 1.0}) {
      for (const double rough : {0.3, 0.5, 0.7, 1.0}) result.push_back(metal_rough(DVector(albedo), metal, rough));
    }
  }
  return result;
}

TEST(Brdf, IsReciprocal) {
  Random random(1);
  for (const Reflection& surface : surfaces()) {
    for (int i = 0; i < 50; ++i) {
      const DVector a = direction(random.between(0.01, 1.0), random.between(0.0, 7.0));
      const DVector b = direction(random.between(0.01, 1.0), random.between(0.0, 7.0));
      const double there = reflected(surface, kUp, a, b).x, back = reflected(surface, kUp, b, a).x;
      EXPECT_NEAR(there, back, 1e-12 * std::max(1.0, there));
    }
  }
}

TEST(Brdf, SendsOnNoMoreLightThanComes) {
  for (const Reflection& surface : surfaces()) {
    for (const double cosine : {1.0, 0.7, 0.4, 0.15, 0.03}) {
      EXPECT_LE(albedo(surface, cosine), 1 + kQuadratureError)
          << static_cast<int>(surface.kind) << " exponent " << surface.exponent << " alpha " << surface.alpha
          << " diffuse " << surface.diffuse.x << " specular " << surface.specular.x << " cosine " << cosine;
    }
  }
}

TEST(Brdf, ADiffuseSurfaceSendsOnItsAlbedo) {
  const Reflection surface = blinn_phong({0.25, 0.5, 1}, DVector(0), 100);
  EXPECT_EQ(surface.kind, Reflection::Kind::Diffuse);
  EXPECT_EQ(reflected(surface, kUp, kUp, kUp), DVector(0.25, 0.5, 1));
  EXPECT_EQ(reflected_ambient(surface), DVector(0.25, 0.5, 1));
}

TEST(Brdf, AHighlightIsKsAtItsPeakAndFallsWithThePower) {
  const Reflection surface = blinn_phong(DVector(0.25), DVector(0.5), 40);
  EXPECT_DOUBLE_EQ(reflected(surface, kUp, kUp, kUp).x, 0.75);
  const double angle = 0.3;  // between the two, so that the half vector is half as far from the normal
  const DVector view(elementary::sin(angle), 0, elementary::cos(angle));
  EXPECT_NEAR(reflected(surface, kUp, kUp, view).x, 0.25 + 0.5 * std::pow(std::cos(angle / 2), 40), 1e-12);
}

TEST(Brdf, AHighlightTakesWhatTheDiffusePartLeaves) {
  EXPECT_EQ(blinn_phong(DVector(1), DVector(1), 40).specular, DVector(0));
  // All light that comes along the normal is sent on.
  EXPECT_NEAR(albedo(blinn_phong(DVector(0.99), DVector(1), 20), 1), 1, 1e-3);
  EXPECT_EQ(blinn_phong(DVector(0.2), DVector(1), 20).specular, DVector(1)) << "not more than asked for";
  EXPECT_EQ(blinn_phong(DVector(0.2), DVector(1), 0).kind, Reflection::Kind::Diffuse) << "no Ns, no highlight";
}

// GGX along the normal: D = 1 / (pi a^2), V = 1 / 4 there.
TEST(Brdf, MetalRoughHasKnownValuesAlongTheNormal) {
  for (const double rough : {0.3, 0.6, 1.0}) {
    const double a2 = rough * rough * rough * rough;
    EXPECT_NEAR(reflected(metal_rough({0.9, 0.5, 0.1}, 1, rough), kUp, kUp, kUp).y, 0.5 / (4 * a2), 1e-12 / a2);
    EXPECT_NEAR(reflected(metal_rough(DVector(0.5), 0, rough), kUp, kUp, kUp).x, 0.5 * 0.96 * 0.96 + 0.04 / (4 * a2),
                1e-12 / a2);
  }
}

TEST(Brdf, FresnelMakesEverythingWhiteAtTheHorizon) {
  const DVector light = direction(0.001, 0), view = direction(0.001, elementary::kPi);
  const DVector value = reflected(metal_rough({1, 0, 0}, 0, 1), kUp, light, view);
  EXPECT_NEAR(value.x, value.y, 0.01 * value.y);
}

TEST(Brdf, IsFiniteWhereDirectionsLieBelow) {
  for (const Reflection& surface : surfaces()) {
    for (const double cosine : {0.0, -0.001, -1.0}) {
      const DVector value = reflected(surface, kUp, direction(1e-9, 0), direction(cosine, 2));
      EXPECT_TRUE(std::isfinite(value.x) && value.x >= 0) << cosine;
    }
  }
}

TEST(Brdf, ParametersAreCutToTheirRange) {
  const Reflection surface = metal_rough({2, -1, 0.5}, 7, -3);
  EXPECT_EQ(surface.specular, DVector(1, 0, 0.5));
  EXPECT_EQ(surface.diffuse, DVector(0));
  EXPECT_DOUBLE_EQ(surface.alpha, kLeastRoughness * kLeastRoughness);
}

}  // namespace
}  // namespace facemap
