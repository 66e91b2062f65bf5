#include "scene/odd_faces.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "math/exact_sign.h"

namespace facemap {

namespace {

std::uint64_t hash(const Corners& item) {
  // Multiply and fold, with odd constants of no meaning (golden ratio and the like).
  std::uint64_t h = (std::uint64_t{item[0]} << 32 | item[1]) * 0x9E3779B97F4A7C15u;
  h ^= h >> 32;
  h = (h ^ item[2]) * 0xD6E8FEB86659FD93u;
  return h ^ h >> 32;
}

std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value == 0 ? 0.0f : value); }

bool repeats_vertex(const Corners& c) { return c[0] == c[1] || c[1] == c[2] || c[2] == c[0]; }

}  // namespace

std::vector<std::uint32_t> first_equal(const std::vector<Corners>& items) {
  // Sorts indices into buckets by hash, keeping their order, and then each bucket by value.
  const std::uint64_t mask = std::bit_ceil(items.size() / 2 + 1) - 1;
  std::vector<std::uint32_t> bucket_end(mask + 2, 0);
  for (const Corners& item : items) ++bucket_end[(hash(item) & mask) + 1];
  std::partial_sum(bucket_end.begin(), bucket_end.end(), bucket_end.begin());
  std::vector<std::uint32_t> order(items.size());
  for (std::uint32_t i = 0; i < items.size(); ++i) order[bucket_end[hash(items[i]) & mask]++] = i;

  std::vector<std::uint32_t> first(items.size());
  auto begin = order.begin();
  for (std::uint64_t bucket = 0; bucket <= mask; ++bucket) {
    const auto end = order.begin() + bucket_end[bucket];
    std::sort(begin, end,
              [&](std::uint32_t a, std::uint32_t b) { return items[a] != items[b] ? items[a] < items[b] : a < b; });
    for (auto i = begin; i != end; ++i) {
      first[*i] = i != begin && items[*i] == items[i[-1]] ? first[i[-1]] : *i;
    }
    begin = end;
  }
  return first;
}

std::vector<std::uint32_t> weld(const std::vector<Vector>& positions) {
  std::vector<Corners> items;
  items.reserve(positions.size());
  for (const Vector& p : positions) items.push_back({bits(p.x), bits(p.y), bits(p.z)});
  return first_equal(items);
}

OddFaces find_odd_faces(const Mesh& mesh, std::vector<std::uint8_t>& kept) {
  OddFaces odd;
  kept.assign(mesh.face_count(), 0);
  const std::vector<std::uint32_t> welded = weld(mesh.positions);

  std::vector<Corners> faces;  // that have an area, with their welded corners ascending
  std::vector<std::uint32_t> ids;
  faces.reserve(mesh.face_count());
  ids.reserve(mesh.face_count());
  for (std::size_t i = 0; i < mesh.face_count(); ++i) {
    const Corners& c = mesh.triangles[i];
    Corners w = {welded[c[0]], welded[c[1]], welded[c[2]]};
    if (repeats_vertex(c)) {
      ++odd.repeated_vertex;
    } else if (repeats_vertex(w) || is_degenerate(mesh.vertex(i, 0), mesh.vertex(i, 1), mesh.vertex(i, 2))) {
      ++odd.zero_area;
    } else {
      std::sort(w.begin(), w.end());
      faces.push_back(w);
      ids.push_back(static_cast<std::uint32_t>(i));
    }
  }
  const std::vector<std::uint32_t> first = first_equal(faces);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const bool is_first = first[i] == i;
    kept[ids[i]] = is_first;
    odd.duplicate += !is_first;
  }
  return odd;
}

}  // namespace facemap
