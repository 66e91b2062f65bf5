#include "visibility/hub_pass.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "map/face_planes.h"

namespace facemap {
namespace {

using simd::kHubSides;

// Vectors of the kernels may read and write this many elements past what they use.
constexpr std::size_t kPadding = 16;

// Packs are fetched so many before they are needed.
constexpr std::size_t kAhead = 2;

// What each thing takes, about: nanoseconds.
constexpr double kSortWork = 10, kCandidateWork = 5, kPackWork = 20, kBoxWork = 4, kBundleWork = 40, kOpenWork = 100;

constexpr int kFewestTexels = 4, kMostTexels = 256;

int texels_for(std::size_t count) {
  int texels = kFewestTexels;
  while (texels < kMostTexels && kHubSides * static_cast<std::size_t>(texels * texels) < count) {
    texels *= 2;
  }
  return texels;
}

}  // namespace

void HubPass::run(const Scene& scene, const FacePacks& packs, const Vector& hub, std::uint32_t own,
                  const ScaledPoints& ends, std::vector<Blocker>& blockers) {
  blockers.clear();
  work_ = 0;
  if (packs.size() == 0) return;
  origin_ = hub;
  hub_ = packs.scaled(hub);
  aim(ends, own);
  sort();
  order_bundles(packs, {-1, 0});
  open_.clear();
  std::size_t blocked = 0;  // that have been taken out
  simd::HubBox boxes[kHubSides * simd::PackBoxes::kPacks];
  for (std::size_t next = 0; next < order_.size(); ++next) {
    const Distance distance = order_[next];
    const std::size_t count = simd::sift_boxes(packs.boxes(distance.bundle), &hub_.x, raster(), boxes);
    std::size_t last = packs.size();  // that planes_ is of
    work_ += kBundleWork + kBoxWork * static_cast<double>(count);
    for (std::size_t i = 0; i < count; ++i) {
      if (i + kAhead < count) packs.prefetch(distance.bundle * simd::PackBoxes::kPacks + boxes[i + kAhead].pack);
      const std::size_t found = simd::find_behind(boxes[i], raster(), sorted(), candidates_.data());
      if (found == 0) continue;
      const std::size_t pack = distance.bundle * simd::PackBoxes::kPacks + boxes[i].pack;
      work_ += kCandidateWork * static_cast<double>(found);
      if (pack != last) work_ += kPackWork;
      if (pack != last) set_up_planes(scene, packs, pack, &hub_.x, origin_, planes_);
      last = pack;
      ask(static_cast<std::uint32_t>(pack), found, blockers);
    }
    if (4 * (blockers.size() - blocked) <= 3 * count_) continue;
    resolve(scene, packs, ends, blockers);
    blocked = blockers.size();
    drop_blocked();
    order_bundles(packs, distance);
    next = static_cast<std::size_t>(-1);
  }
  resolve(scene, packs, ends, blockers);
  ask_singly(scene, packs, own, ends, blockers);
}

void HubPass::aim(const ScaledPoints& ends, std::uint32_t own) {
  count_ = ends.given.size();
  const std::size_t room = count_ + kPadding;
  const auto make_room = [&](auto& array) { array.resize(std::max(array.size(), room)); };
  for (auto& array : aimed_) make_room(array);
  for (auto* array : {&x_, &y_, &z_, &w_}) make_room(*array);
  for (auto* array : {&numbers_, &own_, &numbers_from_, &own_from_, &texel_of_, &candidates_}) make_room(*array);
  make_room(verdicts_);
  std::iota(numbers_from_.begin(), numbers_from_.begin() + static_cast<std::ptrdiff_t>(count_), 0u);
  if (own == FacePacks::kNoPlace) {
    std::copy(ends.own.begin(), ends.own.end(), own_from_.begin());
  } else {
    std::fill_n(own_from_.begin(), count_, own);
  }
  simd::aim_at(&hub_.x, ends.x.data(), ends.y.data(), ends.z.data(), count_, as_they_come());
  near_.clear();
  for (std::size_t i = 0; i < count_; ++i) {
    if (aimed_[3][i] == simd::kNoHubTarget) near_.push_back(static_cast<std::uint32_t>(i));
  }
}

void HubPass::sort() {
  work_ += kSortWork * static_cast<double>(count_);
  texels_ = texels_for(count_);
  simd::find_hub_texels(as_they_come(), count_, texels_, texel_of_.data());
  begins_.assign(static_cast<std::size_t>(kHubSides * texels_ * texels_) + 1, 0);
  for (std::size_t i = 0; i < count_; ++i) ++begins_[texel_of_[i]];
  std::uint32_t sum = 0;
  for (auto& begin : begins_) {
    sum += begin;
    begin = sum;
  }
  for (std::size_t i = count_; i-- > 0;) {
    const std::uint32_t place = --begins_[texel_of_[i]];
    x_[place] = aimed_[0][i];
    y_[place] = aimed_[1][i];
    z_[place] = aimed_[2][i];
    w_[place] = aimed_[3][i];
    numbers_[place] = numbers_from_[i];
    own_[place] = own_from_[i];
  }
  count_texels();
}

// Sorts anew those that nothing has blocked so far, into a raster that suits their number.
void HubPass::drop_blocked() {
  std::size_t kept = 0;
  for (std::size_t place = 0; place < count_; ++place) {
    aimed_[0][kept] = x_[place];
    aimed_[1][kept] = y_[place];
    aimed_[2][kept] = z_[place];
    aimed_[3][kept] = w_[place];
    numbers_from_[kept] = numbers_[place];
    own_from_[kept] = own_[place];
    kept += w_[place] != simd::kNoHubTarget;
  }
  count_ = kept;
  sort();
}

// Of each side the segments before each column and row.
void HubPass::count_texels() {
  const auto n = static_cast<std::size_t>(texels_);
  counts_.assign(kHubSides * (n + 1) * (n + 1), 0);
  for (std::size_t side = 0; side < kHubSides; ++side) {
    const std::uint32_t* begins = begins_.data() + side * n * n;
    std::uint32_t* row = counts_.data() + side * (n + 1) * (n + 1);
    for (std::size_t y = 0; y < n; ++y, begins += n, row += n + 1) {
      for (std::size_t x = 0; x <= n; ++x) row[n + 1 + x] = row[x] + (begins[x] - begins[0]);
    }
  }
}

// Bundles with segments behind them, from front to back: those that come after one.
void HubPass::order_bundles(const FacePacks& packs, const Distance& after) {
  constexpr std::size_t kPacks = simd::PackBoxes::kPacks;
  order_.clear();
  simd::HubBox seen[kHubSides * kPacks];
  for (std::size_t group = 0; group < packs.bundle_groups(); ++group) {
    const simd::PackBoxes& boxes = packs.bundle_boxes(group);
    const std::size_t count = simd::sift_boxes(boxes, &hub_.x, raster(), seen);
    std::uint32_t some = 0;
    for (std::size_t i = 0; i < count; ++i) some |= 1u << seen[i].pack;
    for (; some != 0; some &= some - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(some));
      float squared = 0;
      for (int k = 0; k < 3; ++k) {
        const float away = std::max({0.0f, boxes.lower[k][i] - hub_[k], hub_[k] - boxes.upper[k][i]});
        squared += away * away;
      }
      const Distance distance{squared, static_cast<std::uint32_t>(group * kPacks + i)};
      if (after < distance) order_.push_back(distance);
    }
  }
  std::sort(order_.begin(), order_.end());
}

void HubPass::ask(std::uint32_t pack, std::size_t candidates, std::vector<Blocker>& blockers) {
  const std::size_t found =
      simd::ask_pack(planes_, pack, sorted(), own_.data(), candidates_.data(), candidates, verdicts_.data());
  for (std::size_t k = 0; k < found; ++k) {
    const simd::HubVerdict& verdict = verdicts_[k];
    if (verdict.yes != 0) {
      const auto face = static_cast<std::uint32_t>(std::countr_zero(verdict.yes));
      blockers.push_back({numbers_[verdict.place], pack * 16 + face});
      w_[verdict.place] = simd::kNoHubTarget;
    } else {
      open_.push_back({verdict.place, pack, verdict.open});
    }
  }
}

// Pairs that float32 leaves open are asked exactly, of ends that nothing else hides.
void HubPass::resolve(const Scene& scene, const FacePacks& packs, const ScaledPoints& ends,
                      std::vector<Blocker>& blockers) {
  work_ += kOpenWork * static_cast<double>(open_.size());
  for (const Open& open : open_) {
    for (std::uint32_t faces = open.faces; faces != 0 && w_[open.place] != simd::kNoHubTarget; faces &= faces - 1) {
      const std::uint32_t place = open.pack * 16 + static_cast<std::uint32_t>(std::countr_zero(faces));
      const Triangle corners = triangle_of(scene, packs.face_at(place));
      const std::uint32_t end = numbers_[open.place];
      if (!blocks(corners, side(corners, origin_), origin_, GivenPoint{ends.given[end]})) continue;
      blockers.push_back({end, place});
      w_[open.place] = simd::kNoHubTarget;
    }
  }
  open_.clear();
}

// Ends that are almost at the hub are asked of every face.
void HubPass::ask_singly(const Scene& scene, const FacePacks& packs, std::uint32_t own, const ScaledPoints& ends,
                         std::vector<Blocker>& blockers) {
  for (const std::uint32_t end : near_) {
    if (ends.given[end] == origin_) continue;
    for (const std::uint32_t face : scene.kept_faces()) {
      const std::uint32_t place = packs.place_of(face);
      if (place == (own == FacePacks::kNoPlace ? ends.own[end] : own)) continue;
      const Triangle corners = triangle_of(scene, face);
      if (!blocks(corners, side(corners, origin_), origin_, GivenPoint{ends.given[end]})) continue;
      blockers.push_back({end, place});
      break;
    }
  }
}

std::size_t HubPass::bytes_for(std::size_t count) {
  const auto texels = static_cast<std::size_t>(texels_for(count));
  return count * (17 * sizeof(std::uint32_t) + sizeof(simd::HubVerdict) + sizeof(Open) + sizeof(Blocker) + 1) +
         2 * kHubSides * (texels + 1) * (texels + 1) * sizeof(std::uint32_t);
}

}  // namespace facemap
