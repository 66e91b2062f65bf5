#pragma once

#include <facemap/scene.h>
#include <facemap/vector.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "parallel/executor.h"

namespace facemap {

/// Which faces a ray from an origin may meet. The directions are the six sides of a cube, each a plane with places
/// (u, v) from -1 to 1; there are boxes about what faces fill of it, about eight of these, and so on. All bounds err to
/// one side only.
class FaceTree {
 public:
  /// `faces`: ids of those that count.
  FaceTree(const Scene& scene, const std::vector<std::uint32_t>& faces, const Vector& origin, const Executor& executor);

  /// Sets `found` to faces that the ray along `direction` may meet, all of those among them that it does meet before
  /// the parameter `end`. A direction has finite components, not all 0. Gives the number of boxes looked at.
  std::size_t find(const Vector& direction, double end, std::vector<std::uint32_t>& found) const;

  /// The faces, each once, in an order that keeps together what is seen in close directions.
  std::vector<std::uint32_t> in_order(std::size_t face_count) const;

  std::size_t memory_bytes() const noexcept;

 private:
  static constexpr std::size_t kTogether = 8;

  // What a face fills of a side.
  struct Box {
    float u0, u1, v0, v1, near;
  };
  // Side by side; empty until they are set. `near`: no point of the face has a lesser depth from the origin.
  struct Boxes {
    Boxes();
    void set(std::size_t k, const Box& box);
    Box all() const;
    std::uint32_t met_by(float u, float v, float far) const;  // a bit each

    std::array<float, kTogether> u0, u1, v0, v1, near;
  };
  struct Side {
    std::vector<std::uint32_t> faces;        // along a curve that keeps together what is close
    std::vector<std::vector<Boxes>> levels;  // of faces, then of eight boxes of the level below; the last is one
  };
  static Side make_side(const Scene& scene, const std::vector<std::uint32_t>& faces, const Vector& origin, int side);
  static void add_levels(Side& side);
  static std::optional<Box> box_on(const std::array<DVector, 3>& corners);

  std::array<Side, 6> sides_;
};

}  // namespace facemap
