#include "scene/obj_chunks.h"

#include <algorithm>
#include <atomic>
#include <optional>

#include "scene/number.h"
#include "scene/polygon.h"
#include "scene/reserve_pages.h"

namespace facemap {

namespace {

constexpr std::size_t kLeastChunk = std::size_t{1} << 17, kMostChunk = std::size_t{1} << 22;  // bytes
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// The end of the line at or after `at`; npos if the text has none that surely ends a statement.
std::size_t line_end(std::string_view text, std::size_t at) {
  while ((at = text.find('\n', at)) != std::string_view::npos) {
    const bool has_return = at > 0 && text[at - 1] == '\r';
    const std::size_t before = at - has_return;
    if (before == 0 || text[before - 1] != '\\') return at + 1;
    ++at;
  }
  return std::string_view::npos;
}

/// Cuts a text into pieces of about `size` bytes, each of whole lines with kReadableBeyondEnd bytes behind it. What is
/// left at the end of the text is put into `tail`, and is the last piece.
std::vector<std::string_view> split(std::string_view text, std::size_t size, std::string& tail) {
  std::vector<std::string_view> pieces;
  while (true) {
    const std::size_t end = line_end(text, std::min(size, text.size()));
    if (end == std::string_view::npos || end + kReadableBeyondEnd > text.size()) break;
    pieces.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  tail = text;
  tail.append(1 + kReadableBeyondEnd, '\n');
  pieces.emplace_back(tail.data(), text.size() + 1);
  return pieces;
}

/// Appends the arrays of all chunks to one, giving their memory back on the way.
template <class Value>
void append_all(std::vector<ObjChunk>& chunks, std::vector<Value> ObjChunk::*array, std::vector<Value>& all,
                std::size_t count) {
  reserve_pages(all, count);
  for (ObjChunk& chunk : chunks) {
    all.insert(all.end(), (chunk.*array).begin(), (chunk.*array).end());
    std::vector<Value>().swap(chunk.*array);
  }
}

/// The same for arrays that are empty in chunks without such indices; if they are so in all, this one is, too.
template <class Start>
void append_corners(std::vector<ObjChunk>& chunks, std::vector<Corners> ObjChunk::*array, std::vector<Corners>& all,
                    const std::vector<Start>& starts, std::size_t count) {
  const auto is_empty = [&](const ObjChunk& chunk) { return (chunk.*array).empty(); };
  if (std::all_of(chunks.begin(), chunks.end(), is_empty)) return;
  reserve_pages(all, count);
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    std::vector<Corners>& corners = chunks[i].*array;
    const std::size_t end = i + 1 < chunks.size() ? starts[i + 1].triangle : count;
    all.insert(all.end(), corners.begin(), corners.end());
    all.resize(end, {kNoIndex, kNoIndex, kNoIndex});
    std::vector<Corners>().swap(corners);
  }
}

}  // namespace

bool ObjChunks::read(std::string_view text, const Executor& executor, const Release& release) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  std::string tail;
  const std::size_t wanted = text.size() / (8 * static_cast<std::size_t>(executor.threads()));
  const std::vector<std::string_view> texts = split(text, std::clamp(wanted, kLeastChunk, kMostChunk), tail);
  chunks_.resize(texts.size());
  std::vector<std::uint8_t> needs_counts(texts.size());
  std::atomic<bool> is_odd = false;
  executor.for_each(texts.size(), [&](std::size_t i, int) {
    if (is_odd) return;
    const ObjChunk::Outcome outcome = chunks_[i].read(texts[i], std::nullopt);
    needs_counts[i] = outcome == ObjChunk::Outcome::NeedsCounts;
    const bool is_tail = i + 1 == texts.size();  // which is not in the text
    if (release && !is_tail) release(texts[i]);
    if (outcome == ObjChunk::Outcome::Odd) is_odd = true;
  });
  std::vector<std::size_t> again;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (needs_counts[i] != 0) again.push_back(i);
  }
  if (!is_odd && read_again(texts, again, executor) && find_starts()) return true;
  *this = ObjChunks();
  return false;
}

/// Reads the chunks with indices that count backwards, now that counts can be known.
bool ObjChunks::read_again(const std::vector<std::string_view>& texts, const std::vector<std::size_t>& again,
                           const Executor& executor) {
  if (again.empty()) return true;
  executor.for_each(again.size(), [&](std::size_t i, int) {
    chunks_[again[i]] = ObjChunk();
    chunks_[again[i]].counts = ObjChunk::count(texts[again[i]]);
  });
  std::vector<ObjCounts> before(chunks_.size());
  for (std::size_t i = 1; i < chunks_.size(); ++i) before[i] = before[i - 1] + chunks_[i - 1].counts;

  std::atomic<bool> is_odd = false;
  executor.for_each(again.size(), [&](std::size_t i, int) {
    chunks_[again[i]] = ObjChunk();
    if (chunks_[again[i]].read(texts[again[i]], before[again[i]]) != ObjChunk::Outcome::Done) is_odd = true;
  });
  return !is_odd;
}

/// False if an index refers to what comes later.
bool ObjChunks::find_starts() {
  Start at;
  for (const ObjChunk& chunk : chunks_) {
    if (!chunk.is_backward(at.counts)) return false;
    starts_.push_back(at);
    at.counts = at.counts + chunk.counts;
    at.line += chunk.lines;
    at.triangle += chunk.triangles.size();
    at.polygon += chunk.polygons;
  }
  end_ = at;
  return true;
}

void ObjChunks::move_to(Mesh& mesh, const Executor& executor) {
  const auto size = [](std::int64_t count) { return static_cast<std::size_t>(count); };
  const std::function<void()> tasks[] = {
      [&] { append_all(chunks_, &ObjChunk::triangles, mesh.triangles, end_.triangle); },
      [&] { append_all(chunks_, &ObjChunk::positions, mesh.positions, size(end_.counts.vertices)); },
      [&] { append_all(chunks_, &ObjChunk::normals, mesh.normals, size(end_.counts.normals)); },
      [&] {
        append_all(chunks_, &ObjChunk::texture_coordinates, mesh.texture_coordinates,
                   size(end_.counts.texture_coordinates));
      },
      [&] { append_corners(chunks_, &ObjChunk::normal_corners, mesh.normal_corners, starts_, end_.triangle); },
      [&] { append_corners(chunks_, &ObjChunk::texture_corners, mesh.texture_corners, starts_, end_.triangle); },
      [&] { fill_polygons(mesh.polygons); },
  };
  executor.for_each(std::size(tasks), [&](std::size_t i, int) { tasks[i](); });
}

void ObjChunks::fill_polygons(std::vector<std::uint32_t>& polygons) const {
  if (static_cast<std::size_t>(end_.polygon) == end_.triangle) return;
  reserve_pages(polygons, end_.triangle);
  std::uint32_t polygon = 0;
  for (std::size_t i = 0; i < chunks_.size(); ++i) {
    for (const ObjChunk::Fan& fan : chunks_[i].fans) {
      while (polygons.size() < starts_[i].triangle + fan.first_triangle) polygons.push_back(polygon++);
      polygons.resize(polygons.size() + fan.corner_count - 2, polygon++);
    }
  }
  while (polygons.size() < end_.triangle) polygons.push_back(polygon++);
}

void ObjChunks::visit(const Mesh& mesh, const Executor& executor, const Cut& cut, const Read& read) {
  executor.for_each(chunks_.size(), [&](std::size_t i, int) {
    std::erase_if(chunks_[i].fans, [&](const ObjChunk::Fan& fan) {
      if (fan.corner_count != 4) return false;
      const std::size_t first = starts_[i].triangle + fan.first_triangle;
      return is_strictly_convex(mesh.vertex(first, 0), mesh.vertex(first, 1), mesh.vertex(first, 2),
                                mesh.vertex(first + 1, 2));
    });
  });
  for (std::size_t i = 0; i < chunks_.size(); ++i) {
    const Start& start = starts_[i];
    auto fan = chunks_[i].fans.begin();
    const auto cut_before = [&](std::int64_t line) {
      for (; fan != chunks_[i].fans.end() && fan->line < line; ++fan) {
        cut(start.triangle + fan->first_triangle, fan->corner_count, start.line + fan->line);
      }
    };
    for (const ObjChunk::Statement& statement : chunks_[i].statements) {
      cut_before(statement.line);
      read(statement.text.c_str(), start.line + statement.line, start.triangle + statement.first_triangle);
    }
    cut_before(chunks_[i].lines);
  }
}

}  // namespace facemap
