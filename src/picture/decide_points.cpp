#include "picture/decide_points.h"

#include <algorithm>
#include <mutex>

#include "math/dvector.h"
#include "picture/bytes_of.h"
#include "picture/point_projection.h"

namespace facemap {
namespace {

// What the kernel reaches past the end.
constexpr std::size_t kPadding = 64;

// So many points are looked at before those that are left open are copied: they are still near in memory.
constexpr std::size_t kSlice = 1 << 13;

// One byte a point.
const std::uint8_t* asked_bytes(const MaskBit& mask, std::size_t count, std::vector<std::uint8_t>& room) {
  const std::uint8_t* bytes = mask.asked + mask.bit / 8;
  if (mask.stride == 1) return bytes;
  room.resize(count);
  for (std::size_t i = 0; i < count; ++i) room[i] = bytes[i * mask.stride];
  return room.data();
}

void clear_dark(const std::uint8_t* dark, std::size_t count, const MaskBit& mask) {
  std::uint8_t* lit = mask.lit + mask.bit / 8;
  const int shift = mask.bit % 8;
  const std::size_t stride = mask.stride;
  const auto cleared = [=](std::uint8_t byte, std::uint8_t is_dark) {
    return static_cast<std::uint8_t>(byte & ~(is_dark << shift));
  };
  if (stride == 1) {
    for (std::size_t i = 0; i < count; ++i) lit[i] = cleared(lit[i], dark[i]);
  } else {
    for (std::size_t i = 0; i < count; ++i) lit[i * stride] = cleared(lit[i * stride], dark[i]);
  }
}

// Those without a place go to `others`.
void split_by_place(PointsOnLists& listed, std::vector<std::uint32_t>& others) {
  std::size_t placed = 0;
  for (std::size_t k = 0; k < listed.numbers.size(); ++k) {
    if (listed.texels[k] == simd::OpenPlaces::kNone) {
      others.push_back(listed.numbers[k]);
      continue;
    }
    listed.numbers[placed] = listed.numbers[k];
    listed.texels[placed] = listed.texels[k];
    listed.depths[placed++] = listed.depths[k];
  }
  listed.numbers.resize(placed);
}

// Working memory is kept: little of it is to spare.
void make_room(std::vector<std::uint32_t>& v, std::size_t size) {
  if (size > v.capacity()) v.reserve(size + size / 8);
  v.resize(size);
}

}  // namespace

double size_of_offsets(const AskedPoints& points, const Vector& light) {
  return 3 * points.step * 0x1p31 + 3 * length(points.origin - DVector(light));
}

std::size_t DecidedPoints::memory_bytes() const noexcept {
  return bytes_of(asked) + bytes_of(dark) + bytes_of(numbers) + bytes_of(open.x) + bytes_of(open.y) + bytes_of(open.z) +
         bytes_of(open.faces) + listed.memory_bytes();
}

DecidedCount decide_points(const LightBounds& bounds, const Vector& light, const AskedPoints& points,
                           const MaskBit& mask, DecidedPoints& work, Counters& counters, bool asks_lists) {
  const std::size_t count = points.size();
  const TexelLists* lists = asks_lists ? bounds.lists() : nullptr;
  work.dark.resize(count + kPadding);
  work.numbers.clear();
  work.listed.numbers.clear();
  const auto from = PointProjection(points, light, size_of_offsets(points, light))
                        .onto(bounds.frame(), simd::kShadowGreatestSlack, asked_bytes(mask, count, work.asked),
                              static_cast<std::uint8_t>(1u << (mask.bit % 8)));
  work.faces = bounds.all_faces_are_beyond(from.nearest) ? bounds.faces() : nullptr;
  DecidedCount result;
  std::vector<std::uint32_t>& numbers = lists != nullptr ? work.listed.numbers : work.numbers;
  std::size_t open = 0;
  for (std::size_t first = 0; first < count; first += kSlice) {
    const std::size_t last = std::min(first + kSlice, count), room = open + (last - first) + kPadding;
    make_room(numbers, room);
    simd::OpenPlaces places;
    if (lists != nullptr) {
      make_room(work.listed.texels, room);
      make_room(work.listed.depths, room);
      places = {lists->size(), &work.listed.texels[open], &work.listed.depths[open]};
    }
    const auto counts =
        simd::decide_points(from, bounds.texels(), first, last, work.dark.data(), &numbers[open], places);
    numbers.resize(open + counts.open);
    if (lists == nullptr) copy_points(points, work.numbers, open, work.open);
    open += counts.open;
    result.asked += counts.asked;
  }
  if (lists != nullptr) {
    split_by_place(work.listed, work.numbers);
    copy_points(points, work.numbers, 0, work.open);
  }
  const std::unique_lock lock = mask.hold();
  clear_dark(work.dark.data(), count, mask);
  result.decided = result.asked - open;
  counters.by_float += result.decided;
  return result;
}

}  // namespace facemap
