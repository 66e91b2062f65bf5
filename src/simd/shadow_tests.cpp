#include "simd/shadow_tests.h"

#include <algorithm>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/shadow_tests.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using DF = hn::CappedTag<float, 16>;
using DU = hn::RebindToUnsigned<DF>;
using DI = hn::RebindToSigned<DF>;
using VF = hn::Vec<DF>;
using VI = hn::Vec<DI>;

constexpr std::size_t kLanes = hn::MaxLanes(DF());
constexpr std::size_t kParts = ShadowPlanes::kFaces / kLanes;

// ---- spans: the texels of a row that an edge leaves to its face

// A point of the face has A u + B v + C >= -1, so in the row of texels r, whose middle is at v = (2 r + 1) / rows - 1,
// u lies to the right (A > 0) or left (A < 0) of a line  at + by r. In columns, with what float32 may be off.
struct EdgeLines {
  VF lower_at, lower_by, upper_at, upper_by;
};

// Twenty roundings of the terms of `size` (below), 2^-23 for each; rounded up.
constexpr float kSpanRoundings = 0x1p-18f;

// A line that is nearly a row itself says nothing that the box of the face does not.
constexpr float kLargestSpanSize = 0x1p26f;
constexpr float kNoLine = 0x1p30f;

HWY_INLINE EdgeLines lines_of(const float (*edge)[ShadowPlanes::kFaces], std::size_t i, const ShadowRaster& raster) {
  const DF d;
  const auto A = hn::Load(d, edge[0] + i), B = hn::Load(d, edge[1] + i), C = hn::Load(d, edge[2] + i);
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  const auto half_columns = hn::Set(d, 0.5f * static_cast<float>(raster.columns));
  const float half_row = 1.0f / static_cast<float>(raster.rows);
  const auto scale = hn::Div(half_columns, A);
  const auto reach = hn::Mul(hn::Abs(B), hn::Set(d, half_row + 2 * kShadowMargin));
  const auto middle = hn::Mul(B, hn::Set(d, half_row - 1));  // of row 0
  const auto at = hn::Sub(half_columns, hn::Mul(scale, hn::Add(hn::Add(hn::Add(one, C), reach), middle)));
  const auto by = hn::Neg(hn::Mul(scale, hn::Mul(B, hn::Set(d, 2 * half_row))));
  const auto terms = hn::Add(hn::Add(one, hn::Abs(C)), hn::Mul(hn::Abs(B), hn::Set(d, 4.0f)));
  const auto size = hn::Add(half_columns, hn::Mul(hn::Abs(scale), terms));
  const auto margin = hn::Mul(size, hn::Set(d, kSpanRoundings));

  const auto has_line = hn::Lt(size, hn::Set(d, kLargestSpanSize));
  const auto is_lower = hn::And(has_line, hn::Gt(A, zero)), is_upper = hn::And(has_line, hn::Lt(A, zero));
  return {hn::IfThenElse(is_lower, hn::Sub(at, margin), hn::Set(d, -kNoLine)), hn::IfThenElseZero(is_lower, by),
          hn::IfThenElse(is_upper, hn::Add(at, margin), hn::Set(d, kNoLine)), hn::IfThenElseZero(is_upper, by)};
}

struct Spans {
  EdgeLines edges[3];
  VF left, right;  // of the face's box, in columns
  VI last_column;
  VI row, end_row;
  VI last_block;  // already in a job, or one before the first
  VF nearest;
};

HWY_INLINE VF at_row(VF at, VF by, VF row) { return hn::Add(at, hn::Mul(by, row)); }

HWY_INLINE Spans spans_of(const ShadowBatch& batch, std::size_t i, const ShadowRaster& raster) {
  const DF d;
  const DI di;
  const auto columns = hn::LoadU(di, batch.columns + i), rows = hn::LoadU(di, batch.rows + i);
  const auto low = hn::Set(di, 0xffff);
  Spans s;
  for (int k = 0; k < 3; ++k) s.edges[k] = lines_of(batch.planes->edges[k], i, raster);
  s.left = hn::ConvertTo(d, hn::And(columns, low));
  s.last_column = hn::ShiftRight<16>(columns);
  s.right = hn::ConvertTo(d, hn::Add(s.last_column, hn::Set(di, 1)));
  s.row = hn::And(rows, low);
  s.end_row = hn::Add(hn::ShiftRight<16>(rows), hn::Set(di, 1));
  s.last_block = hn::Set(di, -1);
  s.nearest = hn::LoadU(d, batch.nearest + i);
  return s;
}

struct BlockRun {
  VI next, end;
};

// The blocks that hold the points of the face's span in its row, those of earlier rows apart.
HWY_INLINE BlockRun blocks_of_row(Spans& s, const SortedPoints& points) {
  const DF d;
  const DI di;
  const auto row = hn::ConvertTo(d, s.row);
  auto left = s.left, right = s.right;
  for (const EdgeLines& e : s.edges) {
    left = hn::Max(left, at_row(e.lower_at, e.lower_by, row));
    right = hn::Min(right, at_row(e.upper_at, e.upper_by, row));
  }
  const auto is_in_row = hn::And(hn::RebindMask(di, hn::Le(left, right)), hn::Lt(s.row, s.end_row));
  const auto row_begin = hn::Mul(s.row, hn::Set(di, points.raster.columns));
  const auto first = hn::IfThenElseZero(is_in_row, hn::Add(row_begin, hn::ConvertTo(di, left)));
  const auto last_column = hn::Min(hn::ConvertTo(di, right), s.last_column);
  const auto last = hn::IfThenElseZero(is_in_row, hn::Add(row_begin, last_column));
  const auto* begins = reinterpret_cast<const std::int32_t*>(points.begins);
  const auto begin = hn::GatherIndex(di, begins, first), end = hn::GatherIndex(di, begins + 1, last);
  const auto is_any = hn::And(is_in_row, hn::Lt(begin, end));

  const auto next = hn::Max(hn::ShiftRight<4>(begin), hn::Add(s.last_block, hn::Set(di, 1)));
  const auto last_block = hn::ShiftRight<4>(hn::Sub(end, hn::Set(di, 1)));
  s.last_block = hn::IfThenElse(is_any, hn::Max(s.last_block, last_block), s.last_block);
  s.row = hn::Add(s.row, hn::Set(di, 1));
  return {next, hn::IfThenElseZero(is_any, hn::Add(last_block, hn::Set(di, 1)))};
}

// Appends the next block of each face that has one and may reach its farthest point. Returns whether any has more.
HWY_INLINE bool append_jobs(BlockRun& run, const Spans& s, std::size_t i, const SortedPoints& points, ShadowJobs& jobs,
                            std::size_t& count) {
  const DF d;
  const DI di;
  const DU du;
  const auto has_block = hn::Lt(run.next, run.end);
  if (hn::AllFalse(di, has_block)) return false;
  const auto block = hn::IfThenElseZero(has_block, run.next);
  const auto reaches = hn::Gt(s.nearest, hn::GatherIndex(d, points.farthest, block));
  const auto is_job = hn::And(has_block, hn::RebindMask(di, reaches));
  const auto lane = hn::Add(hn::Iota(du, 0), hn::Set(du, static_cast<std::uint32_t>(i)));
  const auto job = hn::Or(hn::ShiftLeft<4>(hn::BitCast(du, block)), lane);
  if (jobs.size() < count + 2 * ShadowPlanes::kFaces) jobs.resize(2 * jobs.size() + 1024);
  count += hn::CompressStore(job, hn::RebindMask(du, is_job), du, jobs.data() + count);
  run.next = hn::Add(run.next, hn::Set(di, 1));
  return true;
}

// ---- tests

HWY_INLINE std::uint32_t bits_of(hn::Mask<DF> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(DF(), mask, bytes);
  std::uint16_t bits;
  std::memcpy(&bits, bytes, sizeof(bits));
  return bits;
}

HWY_INLINE VF value_at(const float (*plane)[ShadowPlanes::kFaces], std::size_t face, VF u, VF v) {
  const DF d;
  const auto A = hn::Set(d, plane[0][face]), B = hn::Set(d, plane[1][face]), C = hn::Set(d, plane[2][face]);
  return hn::Add(hn::Mul(A, u), hn::Add(hn::Mul(B, v), C));
}

// One bit a point.
struct Verdicts {
  std::uint16_t yes;
  std::uint16_t open;  // neither yes nor no, the face's own points apart
};

// A face's own points are in neither.
HWY_INLINE Verdicts verdicts_of(const ShadowPlanes& planes, std::size_t face, std::uint32_t id,
                                const ShadowBlock& block) {
  const DF d;
  const DU du;
  std::uint32_t yes = 0, no = 0;
  for (std::size_t i = 0; i < ShadowBlock::kPoints; i += kLanes) {
    const auto u = hn::Load(d, block.u + i), v = hn::Load(d, block.v + i), w = hn::Load(d, block.w + i);
    const auto height = value_at(planes.plane, face, u, v);
    const auto beyond = hn::Sub(height, hn::Mul(hn::Set(d, planes.plane[3][face]), w));
    const auto inside = hn::Min(value_at(planes.edges[0], face, u, v),
                                hn::Min(value_at(planes.edges[1], face, u, v), value_at(planes.edges[2], face, u, v)));
    const auto lowest = hn::Min(inside, beyond);
    const auto is_own = hn::RebindMask(d, hn::Eq(hn::Load(du, block.own_face + i), hn::Set(du, id)));
    yes |= bits_of(hn::Gt(lowest, hn::Set(d, 1.0f))) << i;
    no |= bits_of(hn::Or(hn::Lt(lowest, hn::Set(d, -1.0f)), is_own)) << i;
  }
  return {static_cast<std::uint16_t>(yes & ~no), static_cast<std::uint16_t>(~(yes | no))};
}

// Jobs whose verdicts are found before any of them counts: no branch hangs on a verdict.
constexpr std::size_t kRun = 256;

HWY_INLINE std::uint64_t run_jobs(const ShadowBatch& batch, SortedPoints& points, const std::uint32_t* jobs,
                                  std::size_t count, std::vector<UndecidedPair>& undecided) {
  Verdicts verdicts[kRun];
  for (std::size_t j = 0; j < count; ++j) {
    const std::uint32_t face = jobs[j] & 15;
    verdicts[j] = verdicts_of(*batch.planes, face, batch.face[face], points.blocks[jobs[j] >> 4]);
  }
  std::uint64_t open_count = 0;
  for (std::size_t j = 0; j < count; ++j) {
    const std::uint32_t block = jobs[j] >> 4, face = jobs[j] & 15;
    const std::uint32_t after = static_cast<std::uint32_t>(points.blocked[block] | verdicts[j].yes);
    points.blocked[block] = static_cast<std::uint16_t>(after);
    points.farthest[block] = after == 0xffff ? kAllBlocked : points.farthest[block];
    if (verdicts[j].open == 0) continue;
    open_count += static_cast<std::uint32_t>(__builtin_popcount(verdicts[j].open));
    for (std::uint32_t open = verdicts[j].open & ~after; open != 0; open &= open - 1) {
      const std::uint32_t place = block * 16 + static_cast<std::uint32_t>(__builtin_ctz(open));
      undecided.push_back({place, batch.face[face], batch.sides[face]});
    }
  }
  return ShadowBlock::kPoints * count - open_count;
}

std::uint64_t test_points(const ShadowBatch& batch, SortedPoints& points, ShadowJobs& jobs,
                          std::vector<UndecidedPair>& undecided) {
  Spans spans[kParts];
  std::int32_t rows_left = 0;
  for (std::size_t p = 0; p < kParts; ++p) spans[p] = spans_of(batch, p * kLanes, points.raster);
  for (std::size_t i = 0; i < ShadowPlanes::kFaces; ++i) {
    rows_left = std::max(rows_left, (batch.rows[i] >> 16) - (batch.rows[i] & 0xffff) + 1);
  }

  std::size_t count = 0;
  for (; rows_left > 0; --rows_left) {
    BlockRun runs[kParts];
    for (std::size_t p = 0; p < kParts; ++p) runs[p] = blocks_of_row(spans[p], points);
    // One block of each face at a time, so that the order does not depend on the number of lanes.
    for (bool has_more = true; has_more;) {
      has_more = false;
      for (std::size_t p = 0; p < kParts; ++p) {
        has_more |= append_jobs(runs[p], spans[p], p * kLanes, points, jobs, count);
      }
    }
  }
  std::uint64_t decided = 0;
  for (std::size_t j = 0; j < count; j += kRun) {
    decided += run_jobs(batch, points, jobs.data() + j, std::min(kRun, count - j), undecided);
  }
  return decided;
}

}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facemap::simd {

std::uint64_t test_points(const ShadowBatch& batch, SortedPoints& points, ShadowJobs& jobs,
                          std::vector<UndecidedPair>& undecided) {
  return FACEMAP_DISPATCH(test_points)(batch, points, jobs, undecided);
}

}  // namespace facemap::simd
#endif
