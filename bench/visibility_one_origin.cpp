#include "visibility_one_origin.h"

#include <facemap/viewpoint.h>

#include <cstdio>
#include <limits>

#include "facemap_bench_cases.h"
#include "facemap_bench_clock.h"
#include "facemap_bench_embree.h"
#include "facemap_bench_spread.h"
#include "visibility_rays.h"
#include "visibility_surface.h"

namespace facemap::bench {
namespace {

constexpr std::size_t kTask = 4096;  // points

// A hierarchy and how it is asked.
struct Way {
  bool low_quality = true, robust = false;
  OcclusionWay occlusion;

  std::string name() const {
    return std::string(low_quality ? "low" : "medium") + (robust ? " robust" : "") + " build, " + occlusion.name();
  }
};

struct Opponents {
  Way beforehand, with_build;
};

/// Both sides on the same points, from one origin.
class Match {
 public:
  Match(const Case& question, const Vector& origin, std::span<const Vector> points, std::span<const FaceId> faces,
        int threads, int repeat)
      : scene_(question.scene),
        origin_(origin),
        points_(points),
        faces_(faces),
        threads_(threads),
        repeat_(repeat),
        embree_(question.scene, threads, false),
        ours_(points.size()),
        theirs_(points.size()) {}

  void play(const char* name) {
    const Opponents best = calibrate();
    std::printf("%s, %d thread%s, packets of %d\n", name, threads_, threads_ == 1 ? "" : "s", embree_.packet_width());
    const Viewpoint kept(scene_, origin_, {threads_});
    kept.prepare();
    embree_.build(best.beforehand.low_quality, best.beforehand.robust);
    print_row(
        "built beforehand", best.beforehand, [&] { kept.visible({points_}, ours_); },
        [&] { trace(best.beforehand.occlusion); });
    print_row(
        "own faces given", best.beforehand,
        [&] {
          kept.visible({points_, faces_}, ours_);
        },
        [&] { trace(best.beforehand.occlusion); });
    print_row(
        "with builds", best.with_build, [&] { Viewpoint(scene_, origin_, {threads_}).visible({points_}, ours_); },
        [&] {
          embree_.build(best.with_build.low_quality, best.with_build.robust);
          trace(best.with_build.occlusion);
        });
  }

 private:
  template <class Work>
  static double milliseconds(const Work& work) {
    const Stopwatch watch(Time::Wall);
    work();
    return watch.milliseconds();
  }

  void trace(const OcclusionWay& way) {
    const int tasks = static_cast<int>((points_.size() + kTask - 1) / kTask);
    embree_.for_each(tasks, [&](int i) {
      const std::size_t first = static_cast<std::size_t>(i) * kTask;
      const std::size_t count = std::min(kTask, points_.size() - first);
      ask_embree(embree_, origin_, points_.subspan(first, count), way, theirs_.data() + first);
    });
  }

  Opponents calibrate() {
    Opponents best;
    double least = std::numeric_limits<double>::infinity(), least_with_build = least;
    for (const bool low : {true, false}) {
      for (const bool robust : {false, true}) {
        double build_ms = std::numeric_limits<double>::infinity();
        for (int k = 0; k < 2; ++k) build_ms = std::min(build_ms, embree_.build(low, robust));
        for (const OcclusionWay& occlusion : occlusion_ways()) {
          const auto ask = [&] { trace(occlusion); };
          const double ms = std::min(milliseconds(ask), milliseconds(ask));
          if (ms < least) least = ms, best.beforehand = {low, robust, occlusion};
          if (build_ms + ms < least_with_build)
            least_with_build = build_ms + ms, best.with_build = {low, robust, occlusion};
        }
      }
    }
    return best;
  }

  // Rounds of both, turn by turn.
  template <class Ours, class Theirs>
  void print_row(const char* name, const Way& way, const Ours& ours, const Theirs& theirs) {
    std::vector<double> our_ms, their_ms;
    for (int round = 0; round < repeat_; ++round) {
      for (int turn = 0; turn < 2; ++turn) {
        if (turn == round % 2) {
          our_ms.push_back(milliseconds(ours));
        } else {
          their_ms.push_back(milliseconds(theirs));
        }
      }
    }
    std::size_t differ = 0, seen = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) differ += ours_[i] != theirs_[i], seen += ours_[i];
    const Spread a = spread_of(our_ms), b = spread_of(their_ms);
    std::printf("  %-17s FaceMap %8.2f ms (%.2f..%.2f)  Embree %8.2f ms (%.2f..%.2f)  speed %.2f\n", name, a.median,
                a.least, a.most, b.median, b.least, b.most, b.median / a.median);
    std::printf("  %-17s %s; %zu of %zu visible, %zu answers differ\n", "", way.name().c_str(), seen, points_.size(),
                differ);
    std::fflush(stdout);
  }

  const Scene& scene_;
  Vector origin_;
  std::span<const Vector> points_;
  std::span<const FaceId> faces_;  // that the points lie on
  int threads_, repeat_;
  Embree embree_;
  std::vector<std::uint8_t> ours_, theirs_;
};

}  // namespace

void measure_one_origin(const VisibilitySettings& settings) {
  for (const std::string& name : settings.scenes) {
    const Case question = make_case(name, Options());
    std::vector<FaceId> faces;
    const std::vector<Vector> points = surface_points(question.scene, settings.points, settings.seed, 0, &faces);
    std::printf("%s: %zu faces, %zu points\n", name.c_str(), question.scene.face_count(), points.size());
    for (const int threads : settings.threads) {
      for (const bool is_light : {true, false}) {
        const Vector& origin = is_light ? question.lights[0].position : question.view.position;
        Match(question, origin, points, faces, threads, settings.repeat).play(is_light ? "first light" : "camera");
      }
    }
  }
}

}  // namespace facemap::bench
