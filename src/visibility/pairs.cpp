#include "visibility/pairs.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace facemap {
namespace {

// Vectors of the kernels may read this many elements past what they use.
constexpr std::size_t kPadding = 16;

// Ends of segments that are asked about together: no fewer, whatever the budget, as all faces are gone through for each
// piece; no more than numbers have room for.
constexpr std::size_t kFewestEnds = 1024, kMostEnds = std::size_t{1} << 24;

// Of an end, in a piece.
constexpr std::size_t kEndBytes = 5 * sizeof(std::uint32_t) + sizeof(Vector);

// How many ends make a piece: a whole number of bytes of a row.
std::size_t piece_for(std::size_t ends, std::size_t fixed_bytes, std::size_t memory, std::size_t workers) {
  std::size_t piece = std::min(ends, kMostEnds);
  const auto bytes = [&](std::size_t count) { return count * kEndBytes + workers * HubPass::bytes_for(count); };
  if (memory != 0) {
    const std::size_t left = memory - std::min(memory, fixed_bytes);
    while (piece > kFewestEnds && bytes(piece) > left) piece /= 2;
    piece = std::max(piece, std::min(ends, kFewestEnds));
  }
  return (piece + 7) / 8 * 8;
}

// With fewer of either there is nothing to choose. Samples: one in so many hubs, held against so many ends at most.
constexpr std::size_t kFewestToChoose = 64, kFewestSamples = 8, kHubsPerSample = 128;
constexpr std::size_t kMostSampledEnds = std::size_t{1} << 16;

struct Box {
  Vector lower, upper;
};

Box box_of(std::span<const Vector> origins, std::span<const Vector> points) {
  Box box{origins[0], origins[0]};
  for (const auto& some : {origins, points}) {
    for (const Vector& p : some) {
      for (int k = 0; k < 3; ++k) {
        box.lower[k] = std::min(box.lower[k], p[k]);
        box.upper[k] = std::max(box.upper[k], p[k]);
      }
    }
  }
  return box;
}

// The bits of x, below 2^20, two zeros before each.
std::uint64_t spread_bits(std::uint64_t x) {
  x = (x | x << 32) & 0x1f00000000ffffu;
  x = (x | x << 16) & 0x1f0000ff0000ffu;
  x = (x | x << 8) & 0x100f00f00f00f00fu;
  x = (x | x << 4) & 0x10c30c30c30c30c3u;
  return (x | x << 2) & 0x1249249249249249u;
}

// The numbers of points along a curve that keeps neighbours together.
std::vector<std::uint32_t> along_a_curve(std::span<const Vector> points) {
  const Box box = box_of(points, {});
  double extent = 0;
  for (int k = 0; k < 3; ++k) extent = std::max(extent, double{box.upper[k]} - double{box.lower[k]});
  const double per_unit = extent > 0 ? (0x1p20 - 1) / extent : 0;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> places(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::uint64_t along = 0;
    for (int k = 0; k < 3; ++k) {
      along |= spread_bits(static_cast<std::uint64_t>((double{points[i][k]} - double{box.lower[k]}) * per_unit)) << k;
    }
    places[i] = {along, static_cast<std::uint32_t>(i)};
  }
  std::sort(places.begin(), places.end());
  std::vector<std::uint32_t> order(points.size());
  for (std::size_t i = 0; i < places.size(); ++i) order[i] = places[i].second;
  return order;
}

FacePacks packs_for(const Scene& scene, std::span<const Vector> origins, std::span<const Vector> points,
                    const Executor& executor) {
  const Box box = box_of(origins, points);
  return FacePacks(scene, box.lower, box.upper, executor);
}

}  // namespace

Pairs::Pairs(const Scene& scene, std::span<const Vector> origins, const Viewpoint::Targets& targets,
             const Executor& executor)
    : scene_(scene),
      origins_(origins),
      targets_(targets),
      executor_(executor),
      packs_(packs_for(scene, origins, targets.points, executor)),
      workers_(static_cast<std::size_t>(executor.threads())) {}

void Pairs::run(std::span<std::uint8_t> bits, std::size_t memory, const std::function<void(std::size_t)>& report) {
  const Hubs kind = choose(memory);
  const std::size_t count = ends(kind).size(), piece = piece_of(kind, memory);
  for (std::size_t first = 0; first < count; first += piece) {
    set_ends(kind, first, std::min(first + piece, count));
    if (kind == Hubs::Origins) {
      ask_origins(first, bits, report);
    } else {
      ask_points(first, bits, report);
    }
  }
}

std::size_t Pairs::piece_of(Hubs kind, std::size_t memory) const {
  return piece_for(ends(kind).size(), FacePacks::bytes_for(scene_), memory, workers_.size());
}

// By samples. What they cost is counted, not timed, so that each run does the same.
Pairs::Hubs Pairs::choose(std::size_t memory) {
  const std::size_t origins = origins_.size(), points = targets_.points.size();
  if (std::min(origins, points) < kFewestToChoose) return origins <= points ? Hubs::Origins : Hubs::Points;
  const auto samples = [](std::size_t hubs) { return std::max(kFewestSamples, hubs / kHubsPerSample); };
  const double by_origins = work_of(Hubs::Origins, samples(origins), memory) * static_cast<double>(origins);
  const double by_points = work_of(Hubs::Points, samples(points), memory) * static_cast<double>(points);
  return by_origins <= by_points ? Hubs::Origins : Hubs::Points;
}

// Of a hub.
double Pairs::work_of(Hubs kind, std::size_t samples, std::size_t memory) {
  const std::size_t count = std::min({ends(kind).size(), kMostSampledEnds, piece_of(kind, memory)});
  const std::size_t hub_count = hubs(kind).size();
  set_ends(kind, 0, count);
  std::vector<double> works(samples);
  executor_.for_each(samples, [&](std::size_t i, int worker) {
    Worker& w = workers_[static_cast<std::size_t>(worker)];
    ask(kind, i * hub_count / samples, w);
    works[i] = w.pass.work();
  });
  return std::accumulate(works.begin(), works.end(), 0.0) / static_cast<double>(samples) *
         (static_cast<double>(ends(kind).size()) / static_cast<double>(count));
}

std::uint32_t Pairs::own_place(std::size_t point) const {
  const FaceId own = targets_.faces.empty() ? kNoFace : targets_.faces[point];
  return own == kNoFace ? FacePacks::kNoPlace : packs_.place_of(static_cast<std::size_t>(own));
}

void Pairs::set_ends(Hubs kind, std::size_t first, std::size_t last) {
  const std::size_t count = last - first;
  const std::span<const Vector> some = ends(kind).subspan(first, count);
  order_ = along_a_curve(some);
  for (auto* coordinates : {&ends_.x, &ends_.y, &ends_.z}) coordinates->resize(count + kPadding);
  ends_.own.assign(count, FacePacks::kNoPlace);
  ends_.given.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vector p = packs_.scaled(some[order_[i]]);
    ends_.x[i] = p.x;
    ends_.y[i] = p.y;
    ends_.z[i] = p.z;
    ends_.given[i] = some[order_[i]];
    if (kind == Hubs::Origins) ends_.own[i] = own_place(first + order_[i]);
  }
}

void Pairs::ask(Hubs kind, std::size_t hub, Worker& worker) const {
  const std::uint32_t own = kind == Hubs::Points ? own_place(hub) : FacePacks::kNoPlace;
  worker.pass.run(scene_, packs_, hubs(kind)[hub], own, ends_, worker.blockers);
}

// Points from `first` on.
void Pairs::ask_origins(std::size_t first, std::span<std::uint8_t> bits,
                        const std::function<void(std::size_t)>& report) {
  const std::size_t row = visibility_row_bytes(targets_.points.size()), count = order_.size();
  executor_.for_each(origins_.size(), [&](std::size_t origin, int worker) {
    Worker& w = workers_[static_cast<std::size_t>(worker)];
    ask(Hubs::Origins, origin, w);
    std::uint8_t* const out = bits.data() + origin * row + first / 8;
    std::fill_n(out, count / 8, std::uint8_t{0xff});
    if (count % 8 != 0) out[count / 8] = static_cast<std::uint8_t>((1u << (count % 8)) - 1);
    for (const Blocker& blocker : w.blockers) {
      const std::uint32_t point = order_[blocker.end];
      out[point / 8] = static_cast<std::uint8_t>(out[point / 8] & ~(1u << (point % 8)));
    }
    report(count);
  });
}

// Origins from `first` on. Eight points share a byte of each row.
void Pairs::ask_points(std::size_t first, std::span<std::uint8_t> bits,
                       const std::function<void(std::size_t)>& report) {
  const std::size_t points = targets_.points.size(), row = visibility_row_bytes(points), count = order_.size();
  executor_.for_each(row, [&](std::size_t column, int worker) {
    Worker& w = workers_[static_cast<std::size_t>(worker)];
    const std::size_t begin = 8 * column, end = std::min(begin + 8, points);
    w.bits.assign(count, static_cast<std::uint8_t>((1u << (end - begin)) - 1));
    for (std::size_t point = begin; point < end; ++point) {
      ask(Hubs::Points, point, w);
      const std::uint32_t others = ~(1u << (point - begin));
      for (const Blocker& blocker : w.blockers) {
        w.bits[blocker.end] = static_cast<std::uint8_t>(w.bits[blocker.end] & others);
      }
    }
    for (std::size_t i = 0; i < count; ++i) bits[(first + order_[i]) * row + column] = w.bits[i];
    report(count * (end - begin));
  });
}

}  // namespace facemap
