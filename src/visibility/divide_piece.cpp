#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "visibility/face_piece.h"

namespace facemap {
namespace {

using Weights = FacePiece::Weights;

// Of a height, relative to the largest there may be: about what rounding leaves of zero. Cuts may lie anywhere.
constexpr double kCutSlack = 0x1p-44;

// Cuts are made at a multiple of 2^-5 of a side, or a finer one near its ends. Weights fit a double exactly.
constexpr int kFewestBits = 5, kMostBits = 12;
constexpr std::uint64_t kFinestScale = std::uint64_t{1} << 48;

// A part of a side: numerator / 2^bits.
struct Share {
  std::uint64_t numerator = 1;
  int bits = 1;
};

// About t, 0 < t < 1, not above it or not below it.
std::optional<Share> share_near(double t, bool below) {
  for (int bits = kFewestBits; bits <= kMostBits; ++bits) {
    const double scaled = t * static_cast<double>(1 << bits);
    const double whole = below ? std::floor(scaled) : std::ceil(scaled);
    if (!(whole >= 1 && whole < static_cast<double>(1 << bits))) continue;
    const auto numerator = static_cast<std::uint64_t>(whole);
    const int even = std::countr_zero(numerator);
    return Share{numerator >> even, bits - even};
  }
  return std::nullopt;
}

// Corners that were made for a piece, each in parts of its own.
struct Corner {
  Weights weights;
  std::uint64_t scale;
};

Corner between(const Corner& from, const Corner& to, const Share& share) {
  const std::uint64_t whole = std::uint64_t{1} << share.bits;
  Corner corner{{}, from.scale * whole};
  for (std::size_t k = 0; k < 3; ++k) {
    corner.weights[k] = from.weights[k] * (whole - share.numerator) + to.weights[k] * share.numerator;
  }
  return corner;
}

}  // namespace

std::size_t FacePiece::longest_side() const {
  std::array<double, 3> lengths;
  for (std::size_t i = 0; i < 3; ++i) {
    const DVector side = points_[(i + 1) % 3] - points_[i];
    lengths[i] = dot(side, side);
  }
  return static_cast<std::size_t>(std::max_element(lengths.begin(), lengths.end()) - lengths.begin());
}

void FacePiece::divide(const Cut& cut, const FacePiece& whole, std::vector<FacePiece>& pieces) const {
  const std::array<Corner, 3> corners{Corner{weights_[0], scale_}, Corner{weights_[1], scale_},
                                      Corner{weights_[2], scale_}};
  const auto add = [&](const Corner& a, const Corner& b, const Corner& c) {
    const std::uint64_t scale = std::max({a.scale, b.scale, c.scale});
    std::array<Weights, 3> weights{a.weights, b.weights, c.weights};
    const std::array<std::uint64_t, 3> own{a.scale, b.scale, c.scale};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::uint64_t& weight : weights[i]) weight *= scale / own[i];
    }
    pieces.push_back(FacePiece(*face_, &whole, origin_, scale, weights));
  };
  if (scale_ >= kFinestScale >> kMostBits) return;

  // The middle's part becomes a piece that the line does not touch.
  const double at_middle = cut.heights[0] + cut.heights[1] + cut.heights[2] < 0 ? -1 : 1;
  const auto sign = [&](std::size_t i) {
    const double height = at_middle * cut.heights[i];
    return height > cut.slack ? 1 : height < -cut.slack ? -1 : 0;
  };
  const auto crossing = [&](std::size_t from, std::size_t to) {
    return share_near(cut.heights[from] / (cut.heights[from] - cut.heights[to]), sign(from) > 0);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    if (sign(i) == 0 && sign(j) * sign(k) < 0) {
      if (const auto share = crossing(j, k)) {
        const Corner m = between(corners[j], corners[k], *share);
        add(corners[i], corners[j], m);
        add(corners[i], m, corners[k]);
        return;
      }
    } else if (sign(i) * sign(j) < 0 && sign(i) * sign(k) < 0) {
      const auto to_j = crossing(i, j), to_k = crossing(i, k);
      if (to_j && to_k) {
        const Corner m = between(corners[i], corners[j], *to_j), n = between(corners[i], corners[k], *to_k);
        add(corners[i], m, n);
        add(m, corners[j], corners[k]);
        add(m, corners[k], n);
        return;
      }
    }
  }
  const std::size_t i = longest_side(), j = (i + 1) % 3, k = (i + 2) % 3;
  const Corner m = between(corners[i], corners[j], {});
  add(corners[i], m, corners[k]);
  add(m, corners[j], corners[k]);
}

FacePiece::Cut FacePiece::along_edge(const SeenFace& other, std::size_t k) const {
  const SeenVertex &p = other.vertices[k], &q = other.vertices[(k + 1) % 3];
  const DVector normal = cross(p.offset, q.offset - p.offset);
  Cut cut;
  for (std::size_t i = 0; i < 3; ++i) cut.heights[i] = dot(normal, points_[i]);
  cut.slack = kCutSlack * length(normal) * face_->reach;
  return cut;
}

FacePiece::Cut FacePiece::along_plane(const SeenFace& other) const {
  Cut cut;
  for (std::size_t i = 0; i < 3; ++i) {
    cut.heights[i] = other.side * dot(other.normal, points_[i] - other.vertices[0].offset);
  }
  cut.slack = kCutSlack * length(other.normal) * (face_->reach + other.reach);
  return cut;
}

}  // namespace facemap
