#include "facemap_bench_rounds.h"

#include <malloc.h>

#include "facemap_bench_clock.h"
#include "facemap_bench_confirm.h"
#include "facemap_bench_limit.h"
#include "facemap_bench_memory.h"

namespace facemap::bench {
namespace {

Renderer::Options renderer_options(const Options& options) {
  Renderer::Options made;
  made.width = made.height = options.size;
  made.samples = options.samples;
  made.strategy = options.strategy;
  made.threads = options.threads;
  return made;
}

/// The lights' maps are made with the first picture.
Renderer::Options keeping_options(const Options& options) {
  Renderer::Options made = renderer_options(options);
  made.light_maps = Renderer::LightMaps::Keep;
  return made;
}

/// The statistics are of the wall clock; where the total is not, they are taken as its parts.
Phases phases_of(const Renderer::Statistics& statistics, double total, Time time) {
  const double sum = statistics.camera_map_ms + statistics.light_maps_ms + statistics.shade_ms;
  const double scale = time == Time::Wall || sum == 0 ? 1 : total / sum;
  return {statistics.camera_map_ms * scale, statistics.light_maps_ms * scale, statistics.shade_ms * scale, total};
}

/// Both sides and what they are asked.
class Match {
 public:
  Match(const Case& question, const Options& options)
      : question_(question),
        options_(options),
        side_(options.size * options.samples),
        time_(options.cpu_time ? Time::Process : Time::Wall),
        home_(question.view, side_, side_, options.samples),
        turned_(question.turned, side_, side_, options.samples),
        embree_(question.scene, options.threads, options.cpu_time) {
    measured_.packet_width = embree_.packet_width();
    measured_.opponents = calibrate(embree_, home_, question.lights);
  }

  Measured play() {
    play_cold();
    weigh_cold();
    play_warm();
    weigh_warm();
    return std::move(measured_);
  }

 private:
  int light_count() const { return static_cast<int>(question_.lights.size()); }

  /// Runs one of ours and one of theirs, by turns first; pages that earlier rounds left are given back before.
  template <class Ours, class Theirs>
  void take_turns(int round, const Ours& ours, const Theirs& theirs) {
    for (int turn = 0; turn < 2; ++turn) {
      malloc_trim(0);
      if (turn == round % 2) {
        ours();
      } else {
        theirs();
      }
    }
  }

  void play_cold() {
    Rounds& rounds = measured_.cold;
    Answer answer(side_, side_, light_count());
    Image image;
    const auto ours = [&] {
      image = Image();
      const Stopwatch watch(time_);
      Renderer renderer(question_.scene, question_.view, question_.lights, renderer_options(options_));
      image = renderer.look();
      const double ms = watch.milliseconds();
      rounds.ours.push_back(phases_of(renderer.statistics(), ms, time_));
      rounds.statistics = renderer.statistics();
    };
    const auto theirs = [&] {
      const EmbreeWay& way = measured_.opponents.cold;
      embree_.drop();
      const Stopwatch watch(time_);
      const double build_ms = embree_.build(way.low_quality, way.robust);
      Phases phases = embree_.trace(home_, question_.lights, way, answer);
      phases.total = watch.milliseconds();
      phases.build = build_ms;
      rounds.theirs.push_back(phases);
    };
    for (int round = 0; round < options_.repeat; ++round) take_turns(round, ours, theirs);
    embree_.drop();
    finish(rounds, question_.view, image, answer);
  }

  void play_warm() {
    Rounds& rounds = measured_.warm;
    const EmbreeWay& way = measured_.opponents.warm;
    Answer answer(side_, side_, light_count());
    Image image;
    Renderer renderer(question_.scene, question_.view, question_.lights, keeping_options(options_));
    renderer.look();
    measured_.keeping_ms = renderer.statistics().light_maps_ms;
    embree_.build(way.low_quality, way.robust);
    measured_.their_bytes = embree_.bytes();
    for (int round = 0; round < options_.repeat; ++round) {
      // There and back; the last one is turned, whatever their number.
      const bool back = (options_.repeat - round) % 2 == 0;
      const auto ours = [&] {
        image = Image();
        const Stopwatch watch(time_);
        renderer.set_view(back ? question_.view : question_.turned);
        image = renderer.look();
        const double ms = watch.milliseconds();
        rounds.ours.push_back(phases_of(renderer.statistics(), ms, time_));
      };
      const auto theirs = [&] {
        const Stopwatch watch(time_);
        Phases phases = embree_.trace(back ? home_ : turned_, question_.lights, way, answer);
        phases.total = watch.milliseconds();
        rounds.theirs.push_back(phases);
      };
      take_turns(round, ours, theirs);
    }
    rounds.statistics = renderer.statistics();
    measured_.our_bytes = static_cast<std::int64_t>(rounds.statistics.map_bytes);
    finish(rounds, question_.turned, image, answer);
    rounds.limit_ns = limit_ns(question_, question_.turned, image, embree_, options_.samples, options_.repeat);
    embree_.drop();
  }

  void finish(Rounds& rounds, const View& view, const Image& image, const Answer& answer) {
    rounds.difference = compare(image, answer);
    rounds.queries = rounds.statistics.light_queries;
    if (!options_.confirm) return;
    measured_.asked_again += rounds.difference.where.size();
    measured_.confirmed += confirm(question_, view, options_, image, rounds.difference.where);
  }

  void weigh_cold() {
    MemoryMeter::start();
    {
      Renderer renderer(question_.scene, question_.view, question_.lights, renderer_options(options_));
      const Image image = renderer.look();
      measured_.cold_memory.ours = MemoryMeter::stop();
    }
    const EmbreeWay& way = measured_.opponents.cold;
    MemoryMeter::start();
    embree_.build(way.low_quality, way.robust);
    Answer answer(side_, side_, light_count());
    embree_.trace(home_, question_.lights, way, answer);
    measured_.cold_memory.theirs = MemoryMeter::stop();
    embree_.drop();
  }

  void weigh_warm() {
    MemoryMeter::start();
    {
      Renderer renderer(question_.scene, question_.view, question_.lights, keeping_options(options_));
      renderer.look();
      MemoryMeter::forget_peak();
      renderer.set_view(question_.turned);
      const Image image = renderer.look();
      measured_.warm_memory.ours = MemoryMeter::stop();
    }
    const EmbreeWay& way = measured_.opponents.warm;
    MemoryMeter::start();
    embree_.build(way.low_quality, way.robust);
    MemoryMeter::forget_peak();
    Answer answer(side_, side_, light_count());
    embree_.trace(turned_, question_.lights, way, answer);
    measured_.warm_memory.theirs = MemoryMeter::stop();
    embree_.drop();
  }

  const Case& question_;
  const Options& options_;
  int side_;
  Time time_;
  Rays home_, turned_;
  Embree embree_;
  Measured measured_;
};

}  // namespace

double Rounds::speed() const {
  std::vector<double> mine, other;
  for (const Phases& phases : ours) mine.push_back(phases.total);
  for (const Phases& phases : theirs) other.push_back(phases.total);
  return spread_of(other).median / spread_of(mine).median;
}

Measured measure(const Case& question, const Options& options) { return Match(question, options).play(); }

}  // namespace facemap::bench
