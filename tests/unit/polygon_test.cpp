#include "scene/polygon.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "support/random.h"

namespace facemap {
namespace {

using Result = PolygonCutter::Result;

struct GridPoint {
  int x, y;
  bool operator==(const GridPoint&) const = default;
};
using Outline = std::vector<GridPoint>;

std::int64_t cross(GridPoint a, GridPoint b, GridPoint c) {
  return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{b.y - a.y} * (c.x - a.x);
}
int turn(GridPoint a, GridPoint b, GridPoint c) {
  const std::int64_t area = cross(a, b, c);
  return (area > 0) - (area < 0);
}

struct Cut {
  Result result;
  std::vector<Corners> triangles;
};

/// Cuts an outline that lies in the plane `origin` + x `u` + y `v` (small whole numbers: exact in float).
Cut cut(const Outline& outline, Vector u = Vector(1, 0, 0), Vector v = Vector(0, 1, 0), Vector origin = Vector(0)) {
  std::vector<Vector> corners;
  for (const GridPoint p : outline) {
    corners.push_back(origin + u * static_cast<float>(p.x) + v * static_cast<float>(p.y));
  }
  PolygonCutter cutter;
  Cut made{cutter.cut(corners), {}};
  if (made.result == Result::Cut) {
    made.triangles = cutter.triangles();
  } else {
    for (std::uint32_t i = 2; i < outline.size(); ++i) made.triangles.push_back({0, i - 1, i});
  }
  return made;
}

/// Triangles whose edges sum to the outline and which all turn its way cover it exactly once: their sum winds
/// around each point as often as the outline does, which is once or never. That is all there is to prove.
void expect_cover(const Outline& outline, const Cut& made, int way, bool may_have_zero_area) {
  const auto n = static_cast<std::uint32_t>(outline.size());
  ASSERT_EQ(made.triangles.size(), n - 2);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::uint32_t i = 0; i < n; ++i) --edges[{i, (i + 1) % n}];
  for (const Corners& t : made.triangles) {
    const int side = turn(outline[t[0]], outline[t[1]], outline[t[2]]);
    EXPECT_TRUE(side == way || (may_have_zero_area && side == 0)) << t[0] << ' ' << t[1] << ' ' << t[2];
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      // An edge walked both ways cancels.
      if (const auto back = edges.find({b, a}); back != edges.end() && back->second > 0) {
        --back->second;
      } else {
        ++edges[{a, b}];
      }
    }
  }
  for (const auto& [edge, count] : edges) EXPECT_EQ(count, 0) << edge.first << "->" << edge.second;
}

void expect_cut_everywhere(const Outline& outline, bool may_have_zero_area = false) {
  std::int64_t area = 0;
  for (std::size_t i = 2; i < outline.size(); ++i) area += cross(outline[0], outline[i - 1], outline[i]);
  const Vector planes[][2] = {{{1, 0, 0}, {0, 1, 0}},  {{0, 1, 0}, {0, 0, 1}},  {{0, 0, 1}, {1, 0, 0}},
                              {{1, 2, 3}, {0, 1, -2}}, {{-1, 0, 0}, {0, 1, 0}}, {{0, 1, 0}, {1, 0, 0}}};
  for (const auto& plane : planes) {
    const Cut made = cut(outline, plane[0], plane[1], Vector(10, -20, 30));
    ASSERT_TRUE(made.result == Result::Cut || made.result == Result::Fan);
    expect_cover(outline, made, area > 0 ? 1 : -1, may_have_zero_area);
  }
}

bool touch(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {
  const auto is_between = [](GridPoint p, GridPoint q, GridPoint r) {  // r on the line pq
    return std::min(p.x, q.x) <= r.x && r.x <= std::max(p.x, q.x) && std::min(p.y, q.y) <= r.y &&
           r.y <= std::max(p.y, q.y);
  };
  const int c_side = turn(a, b, c), d_side = turn(a, b, d), a_side = turn(c, d, a), b_side = turn(c, d, b);
  if (c_side * d_side < 0 && a_side * b_side < 0) return true;
  return (c_side == 0 && is_between(a, b, c)) || (d_side == 0 && is_between(a, b, d)) ||
         (a_side == 0 && is_between(c, d, a)) || (b_side == 0 && is_between(c, d, b));
}

/// Whether an edge meets its neighbours in their common corners alone, and the others not at all.
bool is_free(const Outline& outline, std::size_t edge) {
  const std::size_t n = outline.size();
  const GridPoint a = outline[edge], b = outline[(edge + 1) % n];
  const auto folds_back = [](GridPoint p, GridPoint q, GridPoint r) {
    return turn(p, q, r) == 0 && (p.x - q.x) * (r.x - q.x) + (p.y - q.y) * (r.y - q.y) >= 0;
  };
  for (std::size_t other = 0; other < n; ++other) {
    const GridPoint c = outline[other], d = outline[(other + 1) % n];
    if (other == edge) continue;
    if (other == (edge + 1) % n) {
      if (folds_back(a, b, d)) return false;
    } else if ((other + 1) % n == edge) {
      if (folds_back(c, a, b)) return false;
    } else if (touch(a, b, c, d)) {
      return false;
    }
  }
  return true;
}

/// A simple outline: corners are put into random edges where the new edges touch nothing.
Outline random_outline(Random& random, std::size_t corners, int size) {
  const auto point = [&] { return GridPoint{random.below(size), random.below(size)}; };
  Outline outline = {{0, 0}, {size, 0}, {size / 2, size}};
  for (int tries = 0; outline.size() < corners && tries < 1000; ++tries) {
    const int edge = random.below(static_cast<int>(outline.size()));
    const auto place = outline.insert(outline.begin() + edge + 1, point());
    const auto first = static_cast<std::size_t>(edge);
    if (!is_free(outline, first) || !is_free(outline, first + 1)) outline.erase(place);
  }
  return outline;
}

TEST(Polygon, ConvexIsAFan) {
  EXPECT_EQ(cut({{0, 0}, {2, 0}, {2, 2}, {0, 2}}).result, Result::Fan);
  EXPECT_EQ(cut({{0, 0}, {0, 2}, {2, 2}, {2, 0}}).result, Result::Fan);
  EXPECT_EQ(cut({{0, 0}, {4, 0}, {6, 3}, {4, 6}, {0, 6}, {-2, 3}}).result, Result::Fan);
}

TEST(Polygon, ConcaveQuadIsCutAtItsReflexCorner) {
  for (int first = 0; first < 4; ++first) {
    Outline arrow = {{0, 0}, {4, 4}, {0, 2}, {-4, 4}};
    std::rotate(arrow.begin(), arrow.begin() + first, arrow.end());
    expect_cut_everywhere(arrow);
    std::reverse(arrow.begin(), arrow.end());
    expect_cut_everywhere(arrow);
  }
}

TEST(Polygon, FlatCornersMakeNoZeroAreaIfTheyNeedNot) {
  Outline square = {{0, 0}, {1, 0}, {2, 0}, {4, 0}, {4, 4}, {2, 4}, {0, 4}, {0, 2}};
  for (std::size_t first = 0; first < square.size(); ++first) {
    std::rotate(square.begin(), square.begin() + 1, square.end());
    expect_cut_everywhere(square);
  }
  Outline triangle = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {0, 3}};
  for (std::size_t first = 0; first < triangle.size(); ++first) {
    std::rotate(triangle.begin(), triangle.begin() + 1, triangle.end());
    expect_cut_everywhere(triangle);
  }
}

TEST(Polygon, BridgeToAHoleIsNoCrossing) {
  // A square, a bridge from (0,0) to (2,2), a square hole the other way round, and back.
  const Outline ring = {{0, 0}, {8, 0}, {8, 8}, {0, 8}, {0, 0}, {2, 2}, {2, 6}, {6, 6}, {6, 2}, {2, 2}};
  Outline turned = ring;
  for (std::size_t first = 0; first < ring.size(); ++first) {
    std::rotate(turned.begin(), turned.begin() + 1, turned.end());
    expect_cut_everywhere(turned, true);
  }
}

TEST(Polygon, RepeatedCornersBecomeZeroArea) {
  expect_cut_everywhere({{0, 0}, {4, 0}, {4, 0}, {4, 4}, {0, 4}}, true);
  expect_cut_everywhere({{0, 0}, {0, 0}, {0, 0}, {4, 0}, {0, 4}}, true);
  expect_cut_everywhere({{0, 0}, {4, 0}, {6, -1}, {4, 0}, {4, 4}, {0, 4}}, true);  // a spike
}

TEST(Polygon, CrossingOutlinesAreTold) {
  EXPECT_EQ(cut({{0, 0}, {4, 4}, {4, 0}, {0, 4}}).result, Result::SelfIntersecting);  // areas cancel
  EXPECT_EQ(cut({{0, 0}, {4, 4}, {4, 0}, {0, 6}}).result, Result::SelfIntersecting);
  EXPECT_EQ(cut({{0, 10}, {6, -8}, {-9, 3}, {9, 3}, {-6, -8}}).result, Result::SelfIntersecting);  // a pentagram
  EXPECT_EQ(cut({{0, 0}, {6, 0}, {6, 4}, {2, -2}, {2, 4}, {0, 4}}).result, Result::SelfIntersecting);
}

TEST(Polygon, AllOnOneLineIsNoCrossing) {
  EXPECT_EQ(cut({{0, 0}, {1, 0}, {2, 0}, {3, 0}}).result, Result::Cut);
  EXPECT_EQ(cut({{0, 0}, {3, 0}, {1, 0}, {2, 0}}).result, Result::Cut);
  EXPECT_EQ(cut({{5, 5}, {5, 5}, {5, 5}, {5, 5}}).result, Result::Cut);
}

TEST(Polygon, CombAndSpiralAreCut) {
  Outline comb = {{0, -1}};
  for (int tooth = 0; tooth < 200; ++tooth) {
    comb.insert(comb.begin(), {2 * tooth, 0});
    comb.insert(comb.begin(), {2 * tooth + 1, 50});
  }
  comb.insert(comb.begin(), {400, -1});
  expect_cut_everywhere(comb);

  Outline outer, inner;  // two rectangular spirals, one inside the other
  for (int i = 0; i < 20; ++i) {
    const int r = 100 - 4 * i, s = r - 2;
    for (const GridPoint corner : {GridPoint{-r, -r}, {r, -r}, {r, r}, {-r + 4, r}}) outer.push_back(corner);
    for (const GridPoint corner : {GridPoint{-s, -s}, {s, -s}, {s, s}, {-s + 4, s}}) inner.push_back(corner);
  }
  std::reverse(inner.begin(), inner.end());
  outer.insert(outer.end(), inner.begin(), inner.end());
  expect_cut_everywhere(outer);
}

TEST(Polygon, RandomOutlinesAreCoveredOnce) {
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Outline outline =
        random_outline(random, 4 + static_cast<std::size_t>(random.below(40)), 5 + random.below(40));
    if (outline.size() > 3) expect_cut_everywhere(outline);
    if (HasFailure()) return;
  }
}

TEST(Polygon, RandomOutlinesWithSpikesAndRepeatedCornersAreCoveredOnce) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Outline outline = random_outline(random, 12, 30);
    for (int i = 0; i < 4; ++i) {
      const int at = random.below(static_cast<int>(outline.size()));
      const GridPoint root = outline[static_cast<std::size_t>(at)], tip = {random.below(30), random.below(30)};
      bool is_clear = true;  // the spike touches nothing but its root
      for (std::size_t j = 0; j < outline.size(); ++j) {
        const GridPoint c = outline[j], d = outline[(j + 1) % outline.size()];
        is_clear &=
            c == root || d == root ? turn(root, tip, c) != 0 || turn(root, tip, d) != 0 : !touch(root, tip, c, d);
      }
      const auto place = outline.begin() + at + 1;
      if (is_clear && random.chance(0.7)) {
        outline.insert(place, {tip, root});
      } else {
        outline.insert(place, root);
      }
    }
    expect_cut_everywhere(outline, true);
    if (HasFailure()) return;
  }
}

/// A zigzag ribbon: no edges cross, but all overlap in x, so that no order of x can thin them out.
std::vector<Vector> ribbon(int teeth) {
  std::vector<Vector> corners;
  for (int i = 0; i < teeth; ++i) corners.push_back(Vector(i % 2 == 0 ? 0 : 1e6f, i, 0));
  for (int i = teeth - 1; i >= 0; --i) corners.push_back(Vector(i % 2 == 0 ? -16 : 1e6f - 16, i, 0));
  return corners;
}

TEST(Polygon, WorkStaysInProportion) {
  PolygonCutter cutter;
  EXPECT_EQ(cutter.cut(ribbon(20'000)), Result::TooIntricate);
  EXPECT_EQ(cutter.cut(ribbon(200)), Result::Cut);
}

mpq_class exact(float x) { return mpq_class(static_cast<double>(x)); }

TEST(Orientation, IsExact) {
  for (std::uint64_t seed = 1; seed <= 20'000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const int spread = random.chance(0.5) ? 3 : 140;
    const auto coordinate = [&] {
      return static_cast<float>(std::ldexp(random.between(-9, 9), random.between(-spread, std::min(spread, 120))));
    };
    PlanePoint p[3];
    for (PlanePoint& point : p) point = {coordinate(), coordinate()};
    if (random.chance(0.5)) {  // the third one as near to the line as floats allow
      const double t = random.between(-2.0, 2.0);
      p[2].x = static_cast<float>(p[0].x + t * (static_cast<double>(p[1].x) - p[0].x));
      p[2].y = static_cast<float>(p[0].y + t * (static_cast<double>(p[1].y) - p[0].y));
    }
    const mpq_class area = (exact(p[1].x) - exact(p[0].x)) * (exact(p[2].y) - exact(p[0].y)) -
                           (exact(p[1].y) - exact(p[0].y)) * (exact(p[2].x) - exact(p[0].x));
    EXPECT_EQ(orientation(p[0], p[1], p[2]), sgn(area));
    EXPECT_EQ(orientation(std::span<const PlanePoint>(p)), sgn(area));
    if (HasFailure()) return;
  }
}

TEST(Orientation, OfLongOutlinesIsExact) {
  // There and back over the same corners, with one corner moved by the least that a float can.
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    std::vector<PlanePoint> outline;
    for (int i = 0; i < 30; ++i) {
      outline.push_back(
          {static_cast<float>(random.between(-1e6, 1e6)), static_cast<float>(random.between(-1e-3, 1e-3))});
    }
    for (int i = 28; i > 0; --i) outline.push_back(outline[static_cast<std::size_t>(i)]);
    EXPECT_EQ(orientation(outline), 0);
    outline[10].y = std::nextafter(outline[10].y, 1.0f);
    mpq_class area = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const PlanePoint a = outline[i], b = outline[(i + 1) % outline.size()];
      area += exact(a.x) * exact(b.y) - exact(a.y) * exact(b.x);
    }
    EXPECT_EQ(orientation(outline), sgn(area));
  }
}

}  // namespace
}  // namespace facemap
