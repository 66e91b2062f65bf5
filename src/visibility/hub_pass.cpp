#include "visibility/hub_pass.h"

#include <algorithm>
#include <bit>

#include "map/face_planes.h"

namespace facemap {
namespace {

using simd::kHubSides;

// Vectors of the kernels may read and write this many elements past what they use.
constexpr std::size_t kPadding = 16;

constexpr int kFewestTexels = 4, kMostTexels = 256;
constexpr std::size_t kPointsPerTexel = 1;

int texels_for(std::size_t count) {
  int texels = kFewestTexels;
  while (texels < kMostTexels && kPointsPerTexel * kHubSides * static_cast<std::size_t>(texels * texels) * 2 < count) {
    texels *= 2;
  }
  return texels;
}

}  // namespace

void HubPass::run(const Scene& scene, const FacePacks& packs, const Vector& hub, const ScaledPoints& points,
                  std::span<const std::uint32_t> asked, std::vector<Blocker>& blockers) {
  blockers.clear();
  if (asked.empty() || packs.size() == 0) return;
  origin_ = hub;
  hub_ = packs.scaled(hub);
  sort(points, asked);
  count_texels();
  order_bundles(packs);
  open_.clear();
  simd::HubBox boxes[kHubSides * simd::PackBoxes::kPacks];
  for (const Distance& distance : order_) {
    const std::size_t count = simd::sift_boxes(packs.boxes(distance.bundle), &hub_.x, raster(), boxes);
    std::size_t last = packs.size();  // that planes_ is of
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t found = simd::find_behind(boxes[i], raster(), sorted(), candidates_.data());
      if (found == 0) continue;
      const std::size_t pack = distance.bundle * simd::PackBoxes::kPacks + boxes[i].pack;
      if (pack != last) set_up(scene, packs, pack);
      last = pack;
      ask(static_cast<std::uint32_t>(pack), found, blockers);
    }
  }
  resolve(scene, packs, points, blockers);
  ask_singly(scene, packs, points, blockers);
}

void HubPass::sort(const ScaledPoints& points, std::span<const std::uint32_t> asked) {
  const std::size_t count = asked.size(), room = count + kPadding;
  for (auto& own : from_) own.resize(std::max(own.size(), room));
  for (auto& own : aimed_) own.resize(std::max(own.size(), room));
  texel_of_.resize(std::max(texel_of_.size(), room));
  for (std::size_t i = 0; i < count; ++i) {
    from_[0][i] = points.x[asked[i]];
    from_[1][i] = points.y[asked[i]];
    from_[2][i] = points.z[asked[i]];
  }
  const simd::HubTargets aimed{aimed_[0].data(), aimed_[1].data(), aimed_[2].data(), aimed_[3].data()};
  simd::aim_at(&hub_.x, from_[0].data(), from_[1].data(), from_[2].data(), count, aimed);
  texels_ = texels_for(count);
  simd::find_hub_texels(aimed, count, texels_, texel_of_.data());

  const auto texels = static_cast<std::size_t>(kHubSides * texels_ * texels_);
  begins_.assign(texels + 1, 0);
  near_.clear();
  for (std::size_t i = 0; i < count; ++i) ++begins_[texel_of_[i]];
  std::uint32_t sum = 0;
  for (auto& begin : begins_) {
    sum += begin;
    begin = sum;
  }
  for (auto* own : {&x_, &y_, &z_, &w_}) own->resize(std::max(own->size(), room));
  for (auto* own : {&numbers_, &own_, &candidates_}) own->resize(std::max(own->size(), room));
  verdicts_.resize(std::max(verdicts_.size(), room));
  for (std::size_t i = count; i-- > 0;) {
    const std::uint32_t place = --begins_[texel_of_[i]];
    x_[place] = aimed.x[i];
    y_[place] = aimed.y[i];
    z_[place] = aimed.z[i];
    w_[place] = aimed.w[i];
    numbers_[place] = asked[i];
    own_[place] = points.own[asked[i]];
    if (aimed.w[i] == simd::kNoHubTarget) near_.push_back(asked[i]);
  }
}

// Of each side the points before each column and row.
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

void HubPass::order_bundles(const FacePacks& packs) {
  order_.clear();
  for (std::size_t i = 0; i < packs.bundles(); ++i) {
    const FacePacks::Box& box = packs.bundle(i);
    float squared = 0;
    for (int k = 0; k < 3; ++k) {
      const float away = std::max({0.0f, box.lower[k] - hub_[k], hub_[k] - box.upper[k]});
      squared += away * away;
    }
    order_.push_back({squared, static_cast<std::uint32_t>(i)});
  }
  std::sort(order_.begin(), order_.end(), [](const Distance& a, const Distance& b) {
    return a.squared != b.squared ? a.squared < b.squared : a.bundle < b.bundle;
  });
}

// Sides that float32 leaves open are asked exactly; faces seen edge-on are passed over.
void HubPass::set_up(const Scene& scene, const FacePacks& packs, std::size_t pack) {
  const simd::FacePack& faces = packs.pack(pack);
  const std::size_t count = packs.count(pack);
  std::uint32_t open = simd::set_up_hub_planes(faces, &hub_.x, planes_);
  for (std::size_t i = count; i < simd::FacePack::kFaces; ++i) simd::remove_plane(planes_, i);
  for (open &= (1u << count) - 1; open != 0; open &= open - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(open));
    const int s = side(triangle_of(scene, faces.ids[i]), origin_);
    if (s < 0) simd::turn_plane(planes_, i);
    if (s == 0) simd::remove_plane(planes_, i);
  }
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

// Pairs that float32 leaves open are asked exactly, of points that nothing else hides.
void HubPass::resolve(const Scene& scene, const FacePacks& packs, const ScaledPoints& points,
                      std::vector<Blocker>& blockers) {
  for (const Open& open : open_) {
    for (std::uint32_t faces = open.faces; faces != 0 && w_[open.place] != simd::kNoHubTarget; faces &= faces - 1) {
      const std::uint32_t place = open.pack * 16 + static_cast<std::uint32_t>(std::countr_zero(faces));
      const Triangle corners = triangle_of(scene, packs.face_at(place));
      const std::uint32_t point = numbers_[open.place];
      if (!blocks(corners, side(corners, origin_), origin_, GivenPoint{points.given[point]})) continue;
      blockers.push_back({point, place});
      w_[open.place] = simd::kNoHubTarget;
    }
  }
}

// Points that are almost at the hub are asked of every face.
void HubPass::ask_singly(const Scene& scene, const FacePacks& packs, const ScaledPoints& points,
                         std::vector<Blocker>& blockers) {
  for (const std::uint32_t point : near_) {
    if (points.given[point] == origin_) continue;
    for (const std::uint32_t face : scene.kept_faces()) {
      const std::uint32_t place = packs.place_of(face);
      if (place == points.own[point]) continue;
      const Triangle corners = triangle_of(scene, face);
      if (!blocks(corners, side(corners, origin_), origin_, GivenPoint{points.given[point]})) continue;
      blockers.push_back({point, place});
      break;
    }
  }
}

std::size_t HubPass::bytes_for(std::size_t count) {
  const auto texels = static_cast<std::size_t>(texels_for(count));
  return count * (15 * sizeof(std::uint32_t) + sizeof(simd::HubVerdict) + sizeof(Open)) +
         2 * kHubSides * (texels + 1) * (texels + 1) * sizeof(std::uint32_t);
}

}  // namespace facemap
