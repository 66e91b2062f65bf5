#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "parallel/executor.h"

namespace facemap {

/// Vertices in disjoint sets, each vertex alone at first. Threads may join sets together: the root of a set is its
/// least vertex, whatever the order. (Union-find with path halving; a root is hung below a lesser one.)
class VertexSets {
 public:
  /// Unless `is_shared` one thread alone joins.
  VertexSets(std::size_t count, bool is_shared) : is_shared_(is_shared), parents_(count) {
    for (std::size_t i = 0; i < count; ++i) parents_[i] = static_cast<std::uint32_t>(i);
  }

  void join(std::uint32_t a, std::uint32_t b) {
    if (parent(a) == parent(b)) return;
    while (true) {
      a = find(a);
      b = find(b);
      if (a == b) return;
      if (a < b) std::swap(a, b);
      if (!is_shared_) {
        parents_[a] = b;
        return;
      }
      std::uint32_t expected = a;  // still a root?
      if (cell(a).compare_exchange_strong(expected, b, std::memory_order_relaxed)) return;
    }
  }

  /// Hangs each vertex directly below its root, as root_of needs it; after the last join.
  void flatten(const Executor& executor) {
    for_ranges(executor, parents_.size(), kLeastPiece, [&](std::size_t first, std::size_t last, int) {
      for (std::size_t i = first; i != last; ++i) {
        const auto vertex = static_cast<std::uint32_t>(i);
        cell(vertex).store(find(vertex), std::memory_order_relaxed);
      }
    });
  }

  std::uint32_t root_of(std::uint32_t vertex) const { return parents_[vertex]; }
  std::size_t size() const { return parents_.size(); }

 private:
  static constexpr std::size_t kLeastPiece = 1 << 15;

  std::atomic_ref<std::uint32_t> cell(std::uint32_t vertex) { return std::atomic_ref(parents_[vertex]); }
  std::uint32_t parent(std::uint32_t vertex) { return cell(vertex).load(std::memory_order_relaxed); }

  std::uint32_t find(std::uint32_t vertex) {
    while (true) {
      const std::uint32_t above = parent(vertex);
      if (above == vertex) return vertex;
      const std::uint32_t higher = parent(above);
      if (higher == above) return above;
      // Another thread may have written a still higher one: this is an ancestor all the same.
      cell(vertex).store(higher, std::memory_order_relaxed);
      vertex = higher;
    }
  }

  bool is_shared_;
  std::vector<std::uint32_t> parents_;  ///< a root is its own; never greater than the vertex
};

}  // namespace facemap
