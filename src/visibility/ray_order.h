#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "visibility/ray_lists.h"

namespace facemap {

/// An order of rays in which those after one another ask the same faces: of very many rays in any order, each would
/// else wait for memory.
class RayOrder {
 public:
  using Place = RayLists::Place;

  /// Of rays that have lists at place_of(i): as they come if they are few, or come in runs of one cell already.
  RayOrder(const Executor& executor, const RayLists& lists, std::size_t count,
           std::function<Place(std::size_t)> place_of);

  /// The number of the ray that comes k-th.
  std::size_t operator[](std::size_t k) const { return order_.empty() ? k : order_[k]; }

  /// Where it has its list.
  Place place(std::size_t k) const { return places_.empty() ? place_of_(k) : places_[k]; }

  /// Has the processor fetch what is kept of a later ray in an array by number.
  template <class T>
  void prefetch_after(std::size_t k, const T* by_number) const {
    constexpr std::size_t kAhead = 8;
    if (k + kAhead < order_.size()) __builtin_prefetch(by_number + order_[k + kAhead]);
  }

 private:
  std::function<Place(std::size_t)> place_of_;
  std::vector<std::uint32_t> order_;  // none: as they come
  std::vector<Place> places_;         // in that order; none: not kept
};

}  // namespace facemap
