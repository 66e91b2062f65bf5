#include "scene/odd_faces.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

#include "math/exact_sign.h"
#include "scene/repeats.h"
#include "scene/welded.h"

namespace facemap {

namespace {

constexpr std::size_t kLeastPiece = 1 << 13;  ///< items worth a task of their own

/// What a face is found to be before duplicates are looked for.
enum Oddity : std::uint8_t { kRepeatedVertex, kZeroArea, kHasArea };

std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value == 0 ? 0.0f : value); }

/// p - q for products of two differences of floats, each rounded to double: off by less than 2^-50 (|p| + |q|).
bool surely_differ(double p, double q) { return std::fabs(p - q) > 0x1p-50 * (std::fabs(p) + std::fabs(q)); }

/// True only if the corners are not on one line: a component of the normal is surely not 0.
bool surely_has_area(const Vector& a, const Vector& b, const Vector& c) {
  const DVector u = DVector(b) - DVector(a), v = DVector(c) - DVector(a);
  return surely_differ(u.x * v.y, u.y * v.x) || surely_differ(u.y * v.z, u.z * v.y) ||
         surely_differ(u.z * v.x, u.x * v.z);
}

Oddity oddity_of(const Mesh& mesh, std::size_t face, const std::vector<std::uint32_t>& welded) {
  if (repeats_vertex(mesh.triangles[face])) return kRepeatedVertex;
  const Vector &a = mesh.vertex(face, 0), &b = mesh.vertex(face, 1), &c = mesh.vertex(face, 2);
  if (surely_has_area(a, b, c)) return kHasArea;
  return repeats_vertex(welded_corners(mesh.triangles[face], welded)) || is_degenerate(a, b, c) ? kZeroArea : kHasArea;
}

Key sorted(const Key& key) {
  const auto [a, b, c] = key;  // without branches: which is greater is hard to foresee
  const std::uint32_t least = std::min(std::min(a, b), c), most = std::max(std::max(a, b), c);
  return {least, a ^ b ^ c ^ least ^ most, most};
}

}  // namespace

std::vector<std::uint32_t> weld(const std::vector<Vector>& positions, const Executor& executor) {
  const auto key_of = [&](std::uint32_t i) {
    return Key{bits(positions[i].x), bits(positions[i].y), bits(positions[i].z)};
  };
  const std::vector<Repeat> repeats = RepeatFinder(executor).find(positions.size(), key_of);
  if (repeats.empty()) return {};
  std::vector<std::uint32_t> welded(positions.size());
  for (std::uint32_t i = 0; i < welded.size(); ++i) welded[i] = i;
  for (const Repeat& repeat : repeats) welded[repeat.item] = repeat.first;
  return welded;
}

OddFaces find_odd_faces(const Mesh& mesh, const std::vector<std::uint32_t>& welded, const Executor& executor,
                        std::vector<std::uint8_t>& kept) {
  kept.resize(mesh.face_count());
  std::atomic<std::int64_t> repeated_vertex = 0, zero_area = 0;
  for_ranges(executor, mesh.face_count(), kLeastPiece, [&](std::size_t first, std::size_t last, int) {
    std::array<std::int64_t, 3> counts{};
    for (std::size_t face = first; face != last; ++face) {
      const Oddity oddity = oddity_of(mesh, face, welded);
      kept[face] = oddity == kHasArea;
      ++counts[oddity];
    }
    repeated_vertex += counts[kRepeatedVertex];
    zero_area += counts[kZeroArea];
  });

  const auto key_of = [&](std::uint32_t face) {
    // A face that is odd already gets a key that no other has: the three corners of a face with an area differ.
    return kept[face] != 0 ? sorted(welded_corners(mesh.triangles[face], welded)) : Key{face, face, face};
  };
  const std::vector<Repeat> repeats = RepeatFinder(executor).find(mesh.face_count(), key_of);
  for (const Repeat& repeat : repeats) kept[repeat.item] = 0;
  return {zero_area, repeated_vertex, static_cast<std::int64_t>(repeats.size())};
}

}  // namespace facemap
