// What one question to each exact predicate costs: where doubles decide, and where only integers do.

#include "math/exact_sign.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "math/parallel_signs.h"
#include "support/random.h"

namespace {

using facemap::Triangle;
using facemap::TruePoint;
using facemap::Vector;

constexpr int kQuestions = 1024;  // fits the first caches

// A face G, a point seen on a face F, and where they are seen from.
struct Question {
  Triangle G;
  int side_from_camera, side_from_light;
  Vector K, d, L;
  int side_along_ray, side_along_light;
  Vector light;  // parallel to the way from L to the middle of the point's face
  TruePoint point;
};

// How the point's face lies to G, and how large the coordinates' exponents are apart.
enum class Case { Apart, Coplanar, CoplanarFarFromOrigin, CoplanarWithTinyNumbers };

// Random(z) is a plane z = const, which float32 holds exactly: coplanar faces are exactly so.
Vector corner(Random& random, bool flat, float height) {
  const auto x = static_cast<float>(random.between(-1.0, 1.0)), y = static_cast<float>(random.between(-1.0, 1.0));
  return Vector(x, y, flat ? height : height + static_cast<float>(random.between(-0.1, 0.1)));
}

Triangle face(Random& random, bool flat, float height) {
  const Vector a = corner(random, flat, height), b = corner(random, flat, height), c = corner(random, flat, height);
  return {a, b, c};
}

std::vector<Question> questions(Case kind) {
  Random random(0x5eed0304);
  std::vector<Question> result;
  while (result.size() < kQuestions) {
    const bool flat = kind != Case::Apart;
    Question q;
    q.G = face(random, flat, 0);
    Triangle F = face(random, flat, flat ? 0.0f : -1.0f);
    q.K = corner(random, false, 3);
    q.L = corner(random, false, 2);
    if (kind == Case::CoplanarWithTinyNumbers) q.L.x = 1e-17f;
    const facemap::DVector centre = (facemap::DVector(F[0]) + facemap::DVector(F[1]) + facemap::DVector(F[2])) / 3.0;
    q.d = Vector(centre - facemap::DVector(q.K));
    if (kind == Case::CoplanarFarFromOrigin) {
      for (Vector* v : {&q.G[0], &q.G[1], &q.G[2], &F[0], &F[1], &F[2], &q.K, &q.L}) *v += Vector(300, 200, 100);
    }
    q.side_from_camera = facemap::side(q.G, q.K);
    q.side_from_light = facemap::side(q.G, q.L);
    q.light = Vector(centre - facemap::DVector(q.L));
    q.side_along_ray = facemap::side_along(q.G, q.d);
    q.side_along_light = facemap::side_along(q.G, q.light);
    q.point = {q.K, q.d, F, facemap::side(F, q.K)};
    if (q.side_from_camera != 0 && q.side_from_light != 0 && q.point.s != 0) result.push_back(q);
  }
  return result;
}

// Times ask(question), one after the other; by_exact is the share that integers decided.
template <class Ask>
void measure(benchmark::State& state, Case kind, Ask ask) {
  const std::vector<Question> all = questions(kind);
  facemap::Counters counters;
  std::size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(ask(all[next], &counters));
    next = (next + 1) % kQuestions;
  }
  const auto asked = static_cast<double>(counters.by_double + counters.by_exact);
  if (asked > 0) state.counters["by_exact"] = static_cast<double>(counters.by_exact) / asked;
}

void side(benchmark::State& state, Case kind) {
  measure(state, kind, [](const Question& q, facemap::Counters* counters) { return side(q.G, q.L, counters); });
}

// Exactly flat faces, asked from a point of their plane.
void side_in_plane(benchmark::State& state) {
  measure(state, Case::Coplanar,
          [](const Question& q, facemap::Counters* counters) { return side(q.G, q.point.face[0], counters); });
}

void covers(benchmark::State& state) {
  measure(state, Case::Apart, [](const Question& q, facemap::Counters* counters) {
    return covers(q.G, q.side_from_camera, q.K, q.d, counters).hit;
  });
}

// Rays through a corner, from a point on the same grid: two edges are met exactly.
void covers_corner(benchmark::State& state) {
  measure(state, Case::Coplanar, [](const Question& q, facemap::Counters* counters) {
    const Vector K(q.G[0].x, q.G[0].y, 2);
    return covers(q.G, q.side_from_camera, K, Vector(0, 0, -1), counters).hit;
  });
}

void compare_depth(benchmark::State& state, Case kind) {
  measure(state, kind, [](const Question& q, facemap::Counters* counters) {
    return compare_depth(q.G, q.side_from_camera, q.point.face, q.point.s, q.K, q.d, counters);
  });
}

void blocks(benchmark::State& state, Case kind) {
  measure(state, kind, [](const Question& q, facemap::Counters* counters) {
    return blocks(q.G, q.side_from_light, q.L, q.point, counters);
  });
}

// Parallel light and rays, along the way from the light and the camera to the point.
void side_along(benchmark::State& state) {
  measure(state, Case::Apart,
          [](const Question& q, facemap::Counters* counters) { return side_along(q.G, q.d, counters); });
}

void covers_along(benchmark::State& state) {
  measure(state, Case::Apart, [](const Question& q, facemap::Counters* counters) {
    return covers_along(q.G, q.side_along_ray, q.K, q.d, counters).hit;
  });
}

void blocks_along(benchmark::State& state, Case kind) {
  measure(state, kind, [](const Question& q, facemap::Counters* counters) {
    return blocks_along(q.G, q.side_along_light, q.light, q.point, counters);
  });
}

void ray_parameter(benchmark::State& state) {
  measure(state, Case::Apart,
          [](const Question& q, facemap::Counters*) { return facemap::ray_parameter(q.point).value; });
}

void ray_parameter_and_offset(benchmark::State& state) {
  measure(state, Case::Apart, [](const Question& q, facemap::Counters*) {
    return facemap::offset_from(q.L, q.point, facemap::ray_parameter(q.point)).x;
  });
}

void is_degenerate(benchmark::State& state) {
  measure(state, Case::Apart,
          [](const Question& q, facemap::Counters*) { return facemap::is_degenerate(q.G[0], q.G[1], q.G[2]); });
}

BENCHMARK_CAPTURE(side, apart, Case::Apart);
BENCHMARK(side_in_plane);
BENCHMARK(covers);
BENCHMARK(covers_corner);
BENCHMARK_CAPTURE(compare_depth, apart, Case::Apart);
BENCHMARK_CAPTURE(compare_depth, coplanar, Case::Coplanar);
BENCHMARK_CAPTURE(blocks, apart, Case::Apart);
BENCHMARK_CAPTURE(blocks, coplanar, Case::Coplanar);
BENCHMARK_CAPTURE(blocks, coplanar_far_from_origin, Case::CoplanarFarFromOrigin);
BENCHMARK_CAPTURE(blocks, coplanar_with_tiny_numbers, Case::CoplanarWithTinyNumbers);
BENCHMARK(side_along);
BENCHMARK(covers_along);
BENCHMARK_CAPTURE(blocks_along, apart, Case::Apart);
BENCHMARK_CAPTURE(blocks_along, coplanar, Case::Coplanar);
BENCHMARK(ray_parameter);
BENCHMARK(ray_parameter_and_offset);
BENCHMARK(is_degenerate);

}  // namespace

BENCHMARK_MAIN();
