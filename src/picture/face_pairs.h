#pragma once

#include <facemap/counters.h>
#include <facemap/scene.h>

#include <array>
#include <cstdint>

namespace facemap {

/// Answers for all points of a face F at once whether a face G may block them from a light, and remembers the latest
/// pairs: where faces overlap in one plane, every point of the one is a tie with the other. For one light.
class FacePairs {
 public:
  explicit FacePairs(const Scene& scene) : scene_(scene) {}

  /// True if no point of F lies strictly beyond G's plane, hence G blocks none of them. `side` is that of G from the
  /// light. Counts a true answer as one test, whether remembered or not.
  bool is_clear(std::uint32_t F, std::uint32_t G, int side, Counters& counters);

 private:
  enum class Answer : std::uint8_t { Open, ClearByDouble, ClearByExact };

  struct Entry {
    std::uint32_t F = 0xffffffffu, G = 0xffffffffu;
    Answer answer = Answer::Open;
  };

  Answer find(std::uint32_t F, std::uint32_t G, int side) const;

  static constexpr int kBits = 10;

  const Scene& scene_;
  std::array<Entry, std::size_t{1} << kBits> entries_;
};

}  // namespace facemap
