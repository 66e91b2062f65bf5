#include "math/clip.h"

#include <gtest/gtest.h>

namespace {

using facemap::clip_at_near_plane;
using facemap::DVector;

std::vector<DVector> clip(const std::vector<DVector>& polygon, double near) {
  std::vector<DVector> clipped{DVector(9)};
  clip_at_near_plane(polygon, near, clipped);
  return clipped;
}

TEST(Clip, KeepsWhatIsInFrontAsItIs) {
  const std::vector<DVector> polygon{{0, 0, 1}, {1, 0, 2}, {0, 1, 1}};
  EXPECT_EQ(clip(polygon, 1), polygon);  // the plane itself is kept
}

TEST(Clip, DropsWhatIsBehind) { EXPECT_TRUE(clip({{0, 0, 0.5}, {1, 0, -1}, {0, 1, 0}}, 1).empty()); }

TEST(Clip, CutsOneCornerToAQuad) {
  EXPECT_EQ(clip({{0, 0, 3}, {4, 0, 3}, {0, 4, -1}}, 1),
            (std::vector<DVector>{{0, 0, 3}, {4, 0, 3}, {2, 2, 1}, {0, 2, 1}}));
}

TEST(Clip, CutsTwoCornersToATriangle) {
  EXPECT_EQ(clip({{0, 0, 3}, {4, 0, -1}, {0, 4, -1}}, 1), (std::vector<DVector>{{0, 0, 3}, {2, 0, 1}, {0, 2, 1}}));
}

TEST(Clip, NeighboursGetTheSameVertexOnACommonEdge) {
  const DVector a(0.1, 0.7, 3.3), b(-0.37, 0.11, -1.7), c(5, 0, 2), d(-5, 0, 2);
  const std::vector<DVector> left = clip({a, b, c}, 0.3), right = clip({b, a, d}, 0.3);
  int common = 0;
  for (const DVector& p : left) {
    for (const DVector& q : right) common += p == q && p != a;
  }
  EXPECT_EQ(common, 1);
}

}  // namespace
