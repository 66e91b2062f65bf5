#pragma once

#include <vector>

#include "facemap_bench_cases.h"
#include "facemap_bench_embree.h"
#include "facemap_bench_question.h"
#include "facemap_bench_spread.h"

namespace facemap::bench {

/// Rounds of both sides, turn by turn, on the same question.
struct Rounds {
  std::vector<Phases> ours, theirs;
  Difference difference;  ///< of the last round
  Renderer::Statistics statistics;
  std::size_t queries = 0;  ///< lights asked about points whose faces they are in front of, a round
  double limit_ns = 0;      ///< what such a query costs at the least; warm only

  double speed() const;  ///< the opponent's median time over ours
};

/// Peak bytes beyond the mesh, answers included.
struct Memory {
  std::int64_t ours = 0, theirs = 0;
};

/// All that is measured of one case.
struct Measured {
  Opponents opponents;
  int packet_width = 0;
  Rounds cold, warm;
  Memory cold_memory, warm_memory;
  std::int64_t our_bytes = 0, their_bytes = 0;  ///< of the structures that are kept: maps, hierarchy
  double keeping_ms = 0;                        ///< of making the maps that are kept, once
  std::size_t asked_again = 0, confirmed = 0;   ///< samples that differ, asked of the lists; those that agree with ours
};

Measured measure(const Case& question, const Options& options);

}  // namespace facemap::bench
