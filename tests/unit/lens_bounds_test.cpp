#include <facemap/lens.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "support/lenses.h"
#include "support/random.h"

namespace {

using facemap::DVector;
using facemap::Lens;
using facemap::LensKind;
using facemap::MapPoint;

double angle_between(const DVector& a, const DVector& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

struct Box {
  MapPoint low, high;

  MapPoint middle() const { return (low + high) * 0.5; }
  // The far borders of a piece may be the next one's.
  MapPoint place(double s, double t) const { return low + MapPoint(s, t) * (high - low) * (1 - 1e-9); }
  MapPoint place(Random& random) const { return place(random.unit(), random.unit()); }
};

// A square of pixels within one piece; anywhere, or about the field's end.
Box box_of(const Lens& lens, Random& random) {
  const int piece = std::min(lens.piece_width(), lens.piece_height());
  const int size = std::min(piece, 1 << random.below(6));
  const int x = random.below(lens.width() / lens.piece_width()) * lens.piece_width() +
                random.below(lens.piece_width() - size + 1);
  const int y = random.below(lens.height() / lens.piece_height()) * lens.piece_height() +
                random.below(lens.piece_height() - size + 1);
  return {{x, y}, {x + size, y + size}};
}

class LensBounds : public testing::TestWithParam<NamedLens> {
 protected:
  const Lens& lens_ = GetParam().lens;
};

TEST_P(LensBounds, NoPixelIsWiderThanPixelAngle) {
  Random random(74);
  int tested = 0;
  for (int i = 0; i < 4000; ++i) {
    const Box box = box_of(lens_, random);
    const double bound = lens_.pixel_angle(box.low, box.high);
    EXPECT_LE(bound, lens_.pixel_angle());
    for (int k = 0; k < 8; ++k) {
      const MapPoint p = box.place(random), q = k % 2 ? box.place(random) : p + (box.place(random) - p) * 1e-3;
      const auto a = lens_.direction(p), b = lens_.direction(q);
      if (!a || !b) continue;
      ++tested;
      EXPECT_LE(angle_between(*a, *b), glm::distance(p, q) * bound + 2 * lens_.angle_error()) << p.x << ' ' << p.y;
    }
  }
  EXPECT_GT(tested, 2000);
}

TEST_P(LensBounds, PixelAngleIsReachedNearTheMiddle) {
  // Not four times too large either, where a lens has a simple middle.
  if (lens_.kind() == LensKind::CubeMap || lens_.kind() == LensKind::Equirectangular) return;
  const MapPoint p = *lens_.map_point({0, 0, 1}), step(0.01, 0);
  const double angle = angle_between(*lens_.direction(p - step), *lens_.direction(p + step));
  EXPECT_LE(lens_.pixel_angle(p - step, p + step) * 0.02, 1.4 * angle);
}

TEST_P(LensBounds, CapsHoldTheDirectionsOfTheirBox) {
  Random random(75);
  int tested = 0;
  for (int i = 0; i < 4000; ++i) {
    const Box box = box_of(lens_, random);
    const double radius = lens_.cap_radius(box.low, box.high);
    const auto middle = lens_.direction(box.middle());
    std::optional<DVector> first;
    for (int k = 0; k < 12; ++k) {
      const MapPoint p = k < 4 ? box.place(k % 2, k / 2) : box.place(random);
      const auto d = lens_.direction(p);
      if (!d) continue;
      if (!first) first = d;
      ++tested;
      if (middle) {
        EXPECT_LE(angle_between(*middle, *d), radius) << p.x << ' ' << p.y;
      }
      EXPECT_LE(angle_between(*first, *d), 2 * radius) << p.x << ' ' << p.y;
    }
  }
  EXPECT_GT(tested, 2000);
}

TEST_P(LensBounds, ErrorsAreSmall) {
  // Of the order of what exact candidate search allows directions elsewhere (2^-40); with a fold in the picture more.
  const bool is_folded =
      lens_.pixel_angle() > 100 * lens_.pixel_angle(*lens_.map_point({0, 0, 1}), *lens_.map_point({0, 0, 1}));
  EXPECT_LE(lens_.angle_error(), is_folded ? 0x1p-32 : 0x1p-39);
}

INSTANTIATE_TEST_SUITE_P(Lenses, LensBounds, testing::ValuesIn(all_lenses()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
