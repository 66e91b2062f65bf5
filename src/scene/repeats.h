#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "parallel/executor.h"

namespace facemap {

/// What items are compared by.
using Key = std::array<std::uint32_t, 3>;

/// An item whose key is that of an item before it, and the first of those.
struct Repeat {
  std::uint32_t item = 0, first = 0;

  friend bool operator==(const Repeat&, const Repeat&) = default;
};

/// Finds equal keys: items are put into parts by a hash of their keys, small enough for the processor's caches, and
/// each part into a table of its own. Time is linear, but n log n for keys made to share their hashes; memory is 12
/// bytes an item.
class RepeatFinder {
 public:
  explicit RepeatFinder(const Executor& executor) : executor_(executor) {}

  /// The repeats among 0..count-1, in an order that depends on the keys alone. `key_of(item)` gives a Key.
  template <class KeyOf>
  std::vector<Repeat> find(std::size_t count, const KeyOf& key_of) const {
    const auto part_bits = static_cast<int>(std::bit_width(count / kPartSize));
    const Parts parts = distribute(count, part_bits, key_of);
    std::vector<std::vector<Repeat>> repeats(std::size_t{1} << part_bits);
    for_ranges(executor_, repeats.size(), 1, [&](std::size_t first, std::size_t last, int) {
      Scratch scratch;
      for (std::size_t part = first; part != last; ++part) {
        Entry* const begin = parts.entries.get() + parts.begins[part];
        Entry* const end = parts.entries.get() + parts.begins[part + 1];
        find_in_part(begin, keep_suspects(begin, end, scratch), key_of, scratch.table, repeats[part]);
      }
    });
    std::vector<Repeat> all;
    for (const auto& some : repeats) all.insert(all.end(), some.begin(), some.end());
    return all;
  }

 private:
  struct Entry {
    std::uint32_t hash, item;
  };
  struct Scratch {
    std::vector<std::uint64_t> seen, seen_again;  ///< a bit for each value of some bits of a hash
    std::vector<std::uint32_t> table;
  };
  struct Parts {
    std::unique_ptr<Entry[]> entries;  ///< those of a part side by side, in the order of the items
    std::vector<std::size_t> begins;
  };

  static constexpr std::size_t kPartSize = 4096;
  static constexpr std::size_t kPieceSize = 1 << 13;
  static constexpr std::uint32_t kEmpty = 0xffffffffu;

  static std::uint32_t hash(const Key& key) {
    // Multiply and fold, with odd constants of no meaning (golden ratio and the like).
    std::uint64_t h = (std::uint64_t{key[0]} << 32 | key[1]) * 0x9E3779B97F4A7C15u;
    h ^= h >> 32;
    h = (h ^ key[2]) * 0xD6E8FEB86659FD93u;
    return static_cast<std::uint32_t>(h >> 32);
  }

  template <class KeyOf>
  Parts distribute(std::size_t count, int part_bits, const KeyOf& key_of) const {
    const std::size_t part_count = std::size_t{1} << part_bits;
    const auto part_of = [part_bits](std::uint32_t h) { return std::size_t{h} << part_bits >> 32; };
    const std::size_t pieces = executor_.threads() == 1 ? 1 : std::max<std::size_t>(1, count / kPieceSize);
    // A piece of the items counts what it has for each part; sums of that, part by part, say where it goes.
    const std::size_t used_pieces = std::min<std::size_t>(pieces, 4 * static_cast<std::size_t>(executor_.threads()));
    const auto piece_begin = [&](std::size_t piece) { return count * piece / used_pieces; };

    const auto hashes = std::make_unique_for_overwrite<std::uint32_t[]>(count);
    std::vector<std::uint32_t> places(used_pieces * part_count, 0);
    executor_.for_each(used_pieces, [&](std::size_t piece, int) {
      std::uint32_t* const counts = &places[piece * part_count];
      for (std::size_t i = piece_begin(piece); i != piece_begin(piece + 1); ++i) {
        hashes[i] = hash(key_of(static_cast<std::uint32_t>(i)));
        ++counts[part_of(hashes[i])];
      }
    });

    Parts parts{std::make_unique_for_overwrite<Entry[]>(count), {}};
    std::size_t place = 0;
    for (std::size_t part = 0; part != part_count; ++part) {
      parts.begins.push_back(place);
      for (std::size_t piece = 0; piece != used_pieces; ++piece) {
        std::uint32_t& here = places[piece * part_count + part];
        place += std::exchange(here, static_cast<std::uint32_t>(place));
      }
    }
    parts.begins.push_back(place);

    executor_.for_each(used_pieces, [&](std::size_t piece, int) {
      std::uint32_t* const next = &places[piece * part_count];
      for (std::size_t i = piece_begin(piece); i != piece_begin(piece + 1); ++i) {
        parts.entries[next[part_of(hashes[i])]++] = {hashes[i], static_cast<std::uint32_t>(i)};
      }
    });
    return parts;
  }

  /// Moves the entries whose hashes others have, too, by some of their bits, to the front: a few in a hundred, unless
  /// there are repeats. Returns their end.
  static Entry* keep_suspects(Entry* begin, Entry* end, Scratch& scratch) {
    const std::size_t mask = std::bit_floor(32 * static_cast<std::size_t>(end - begin) + 64) - 1;
    scratch.seen.assign((mask >> 6) + 1, 0);
    scratch.seen_again.assign((mask >> 6) + 1, 0);
    for (const Entry* entry = begin; entry != end; ++entry) {
      const std::size_t place = entry->hash & mask;
      const std::uint64_t bit = std::uint64_t{1} << (place & 63);
      scratch.seen_again[place >> 6] |= scratch.seen[place >> 6] & bit;
      scratch.seen[place >> 6] |= bit;
    }
    Entry* kept = begin;
    for (const Entry* entry = begin; entry != end; ++entry) {
      const std::size_t place = entry->hash & mask;
      *kept = *entry;
      kept += scratch.seen_again[place >> 6] >> (place & 63) & 1;
    }
    return kept;
  }

  template <class KeyOf>
  static void find_in_part(Entry* begin, Entry* end, const KeyOf& key_of, std::vector<std::uint32_t>& table,
                           std::vector<Repeat>& repeats) {
    const std::size_t count = static_cast<std::size_t>(end - begin);
    const std::size_t mask = std::bit_ceil(2 * count + 1) - 1;
    table.assign(mask + 1, kEmpty);
    std::size_t steps_left = 16 * count;  // of which tables of this load take one or two an item
    for (std::uint32_t i = 0; i != count; ++i) {
      std::size_t slot = begin[i].hash & mask;
      while (table[slot] != kEmpty) {
        const Entry& other = begin[table[slot]];
        if (other.hash == begin[i].hash && key_of(other.item) == key_of(begin[i].item)) break;
        if (steps_left-- == 0) {
          repeats.clear();
          sort_part(begin, end, key_of, repeats);
          return;
        }
        slot = (slot + 1) & mask;
      }
      if (table[slot] == kEmpty) {
        table[slot] = i;
      } else {
        repeats.push_back({begin[i].item, begin[table[slot]].item});
      }
    }
  }

  template <class KeyOf>
  static void sort_part(Entry* begin, Entry* end, const KeyOf& key_of, std::vector<Repeat>& repeats) {
    std::sort(begin, end, [&](const Entry& a, const Entry& b) {
      return std::tuple(key_of(a.item), a.item) < std::tuple(key_of(b.item), b.item);
    });
    for (Entry* first = begin; first != end;) {
      Entry* next = first + 1;
      for (; next != end && key_of(next->item) == key_of(first->item); ++next) {
        repeats.push_back({next->item, first->item});
      }
      first = next;
    }
  }

  const Executor& executor_;
};

}  // namespace facemap
