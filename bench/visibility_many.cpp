#include "visibility_many.h"

#include <facemap/visibility.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <numeric>

#include "facemap_bench_cases.h"
#include "facemap_bench_clock.h"
#include "facemap_bench_embree.h"
#include "facemap_bench_spread.h"
#include "visibility_rays.h"
#include "visibility_surface.h"

namespace facemap::bench {
namespace {

// Ways are tried on so many pairs.
constexpr std::size_t kTrial = 400000;

// Of the scene's largest extent: how far origins are moved off the surfaces.
constexpr double kLift = 1e-3;

// A hierarchy, who shares the rays' end, and how it is asked.
struct Way {
  bool low_quality = true, robust = false, is_sorted = true;
  OcclusionWay occlusion;

  std::string name() const {
    return std::string(low_quality ? "low" : "medium") + (robust ? " robust" : "") + " build, " +
           (is_sorted ? "sorted " : "unsorted ") +
           (occlusion.hub_is_point ? "origins about points, " : "points about origins, ") + occlusion.name();
  }
};

std::uint64_t spread_bits(std::uint64_t x) {
  std::uint64_t spread = 0;
  for (int bit = 0; bit < 20; ++bit) spread |= (x >> bit & 1) << (3 * bit);
  return spread;
}

// Numbers of points along a curve that keeps neighbours together.
std::vector<std::uint32_t> sorted_numbers(const std::vector<Vector>& points) {
  Vector lower = points[0], upper = points[0];
  for (const Vector& p : points) {
    for (int k = 0; k < 3; ++k) lower[k] = std::min(lower[k], p[k]), upper[k] = std::max(upper[k], p[k]);
  }
  const float extent = std::max({upper.x - lower.x, upper.y - lower.y, upper.z - lower.z, 1e-30f});
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::uint64_t key = 0;
    for (int k = 0; k < 3; ++k) {
      key |= spread_bits(static_cast<std::uint64_t>((points[i][k] - lower[k]) / extent * 1048575.0f)) << k;
    }
    keys.emplace_back(key, static_cast<std::uint32_t>(i));
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> numbers;
  for (const auto& key : keys) numbers.push_back(key.second);
  return numbers;
}

struct Ordered {
  std::vector<std::uint32_t> numbers;
  std::vector<Vector> points;

  Ordered(const std::vector<Vector>& from, bool is_sorted) : numbers(from.size()) {
    std::iota(numbers.begin(), numbers.end(), 0u);
    if (is_sorted) numbers = sorted_numbers(from);
    for (const std::uint32_t i : numbers) points.push_back(from[i]);
  }
};

/// Both sides on the same pairs.
class Match {
 public:
  Match(const Scene& scene, const std::vector<Vector>& origins, const std::vector<Vector>& points, int threads,
        int repeat)
      : scene_(scene),
        origins_(origins),
        points_(points),
        threads_(threads),
        repeat_(repeat),
        embree_(scene, threads, false),
        bits_(origins.size() * visibility_row_bytes(points.size())),
        theirs_(origins.size() * points.size()) {}

  void play(const char* name, const std::vector<FaceId>& faces) {
    const Way best = calibrate();
    std::printf("%s, %d thread%s, packets of %d\n  %s\n", name, threads_, threads_ == 1 ? "" : "s",
                embree_.packet_width(), best.name().c_str());
    print_row("own faces given", best, faces);
    print_row("points alone", best, {});
  }

 private:
  template <class Work>
  static double milliseconds(const Work& work) {
    const Stopwatch watch(Time::Wall);
    work();
    return watch.milliseconds();
  }

  // Every `step`th hub. Answers stand hub by hub, in the order of both.
  void trace(const Way& way, const Ordered& origins, const Ordered& points, std::size_t step) {
    const auto& hubs = way.occlusion.hub_is_point ? points.points : origins.points;
    const auto& ends = way.occlusion.hub_is_point ? origins.points : points.points;
    embree_.for_each(static_cast<int>(hubs.size() / step), [&](int i) {
      const std::size_t hub = static_cast<std::size_t>(i) * step;
      ask_embree(embree_, hubs[hub], ends, way.occlusion, theirs_.data() + hub * ends.size());
    });
  }

  Way calibrate() {
    const std::size_t step =
        std::clamp<std::size_t>(theirs_.size() / kTrial, 1, std::min(origins_.size(), points_.size()));
    const Ordered origins[] = {{origins_, false}, {origins_, true}}, points[] = {{points_, false}, {points_, true}};
    Way best;
    double least = std::numeric_limits<double>::infinity();
    for (const bool low : {true, false}) {
      for (const bool robust : {false, true}) {
        double build_ms = std::numeric_limits<double>::infinity();
        for (int k = 0; k < 2; ++k) build_ms = std::min(build_ms, embree_.build(low, robust));
        for (OcclusionWay occlusion : occlusion_ways()) {
          for (const bool hub_is_point : {false, true}) {
            occlusion.hub_is_point = hub_is_point;
            for (const bool is_sorted : {false, true}) {
              const Way way{low, robust, is_sorted, occlusion};
              const double ms =
                  milliseconds([&] { trace(way, origins[is_sorted], points[is_sorted], step); }) * double(step);
              if (build_ms + ms < least) least = build_ms + ms, best = way;
            }
          }
        }
      }
    }
    return best;
  }

  // Rounds of both, turn by turn; sorting is counted, as it is of ours.
  void print_row(const char* name, const Way& way, const std::vector<FaceId>& faces) {
    std::vector<double> our_ms, their_ms;
    std::size_t differ = 0, seen = 0;
    for (int round = 0; round < repeat_; ++round) {
      for (int turn = 0; turn < 2; ++turn) {
        if (turn == round % 2) {
          our_ms.push_back(milliseconds([&] {
            visibility(scene_, origins_, {points_, faces}, bits_, {.threads = threads_});
          }));
        } else {
          const Stopwatch watch(Time::Wall);
          embree_.build(way.low_quality, way.robust);
          const Ordered origins(origins_, way.is_sorted), points(points_, way.is_sorted);
          trace(way, origins, points, 1);
          their_ms.push_back(watch.milliseconds());
          if (round == repeat_ - 1 || repeat_ == 1) keep(way, origins, points);
        }
      }
    }
    compare(differ, seen);
    const Spread a = spread_of(our_ms), b = spread_of(their_ms);
    std::printf("  %-17s FaceMap %8.1f ms (%.1f..%.1f)  Embree %8.1f ms (%.1f..%.1f)  speed %.2f\n", name, a.median,
                a.least, a.most, b.median, b.least, b.most, b.median / a.median);
    std::printf("  %-17s %zu of %zu pairs visible, %zu answers differ\n", "", seen, theirs_.size(), differ);
  }

  // Embree's answers as rows of origins, points as they were given.
  void keep(const Way& way, const Ordered& origins, const Ordered& points) {
    kept_.resize(theirs_.size());
    for (std::size_t i = 0; i < origins_.size(); ++i) {
      for (std::size_t j = 0; j < points_.size(); ++j) {
        kept_[origins.numbers[i] * points_.size() + points.numbers[j]] =
            theirs_[way.occlusion.hub_is_point ? j * origins_.size() + i : i * points_.size() + j];
      }
    }
  }

  void compare(std::size_t& differ, std::size_t& seen) const {
    const std::size_t row = visibility_row_bytes(points_.size());
    for (std::size_t i = 0; i < origins_.size(); ++i) {
      for (std::size_t j = 0; j < points_.size(); ++j) {
        const bool is_seen = (bits_[i * row + j / 8] >> (j % 8) & 1) != 0;
        seen += is_seen;
        differ += is_seen != (kept_[i * points_.size() + j] != 0);
      }
    }
  }

  const Scene& scene_;
  const std::vector<Vector>&origins_, &points_;
  int threads_, repeat_;
  Embree embree_;
  std::vector<std::uint8_t> bits_, theirs_, kept_;
};

double extent_of(const Scene& scene) {
  const DVector extent = DVector(scene.upper()) - DVector(scene.lower());
  return std::max({extent.x, extent.y, extent.z});
}

// In the box that the scene's would be if it stood on top of itself.
std::vector<Vector> origins_above(const Scene& scene, std::size_t count, std::uint64_t seed) {
  const DVector extent = DVector(scene.upper()) - DVector(scene.lower());
  const DVector lower(scene.lower().x, scene.upper().y, scene.lower().z);
  std::vector<Vector> origins;
  for (std::size_t i = 0; i < count; ++i) {
    DVector at;
    for (int k = 0; k < 3; ++k) at[k] = lower[k] + extent[k] * random_fraction(seed);
    origins.push_back(Vector(at));
  }
  return origins;
}

}  // namespace

void measure_many_origins(const VisibilitySettings& settings) {
  for (const std::string& name : settings.scenes) {
    const Case question = make_case(name, Options());
    const Scene& scene = question.scene;
    std::vector<FaceId> faces;
    const std::vector<Vector> points = surface_points(scene, settings.points, settings.seed, 0, &faces);
    const std::vector<Vector> near =
        surface_points(scene, settings.origins, settings.seed + 1, kLift * extent_of(scene));
    const std::vector<Vector> above = origins_above(scene, settings.origins, settings.seed + 2);
    std::printf("%s: %zu faces, %zu origins, %zu points, builds included\n", name.c_str(), scene.face_count(),
                settings.origins, points.size());
    for (const int threads : settings.threads) {
      Match(scene, near, points, threads, settings.repeat).play("origins at the surfaces", faces);
      Match(scene, above, points, threads, settings.repeat).play("origins above", faces);
    }
  }
}

}  // namespace facemap::bench
