#include "visibility/face_packs.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <span>

#include "map/face_planes.h"
#include "math/exact_sign.h"
#include "math/power_of_two.h"

namespace facemap {
namespace {

constexpr std::size_t kPackFaces = simd::FacePack::kFaces;
constexpr std::size_t kPacks = simd::PackBoxes::kPacks;
constexpr std::size_t kBundleFaces = kPackFaces * kPacks;

// What is far smaller than the whole may vanish in units of the packs: boxes are so much larger.
constexpr float kUnderflow = 0x1p-100f;

// Without a point, as places are that hold nothing.
const simd::PackBoxes kNoBoxes = [] {
  simd::PackBoxes boxes;
  for (auto& lower : boxes.lower) std::fill(std::begin(lower), std::end(lower), HUGE_VALF);
  for (auto& upper : boxes.upper) std::fill(std::begin(upper), std::end(upper), -HUGE_VALF);
  return boxes;
}();

// Faces that one task divides.
constexpr std::size_t kTaskFaces = 4096;

// Bundles a task.
constexpr std::size_t kFewestPacks = 256;

struct Centre {
  std::uint32_t face;
  Vector at;  // three times the middle, less what is the same for all
};

// How many go left: a whole number of bundles as near to half as may be, or of packs within a bundle.
std::size_t left_part(std::size_t count) {
  const std::size_t unit = count > kBundleFaces ? kBundleFaces : kPackFaces;
  const std::size_t units = (count + unit - 1) / unit;
  return (units + 1) / 2 * unit;
}

struct Part {
  std::size_t first, last;
};

int longest_axis(const Centre* first, const Centre* last) {
  Vector lower = first->at, upper = first->at;
  for (const Centre* c = first; c < last; ++c) {
    for (int k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], c->at[k]);
      upper[k] = std::max(upper[k], c->at[k]);
    }
  }
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (upper[k] - lower[k] > upper[axis] - lower[axis]) axis = k;
  }
  return axis;
}

// Orders faces so that each run of sixteen, and each of 256, are neighbours. Parts of at most `least` are handed to
// `small`.
template <class Small>
void divide(Centre* centres, Part part, std::size_t least, const Small& small) {
  while (part.last - part.first > least) {
    Centre* const first = centres + part.first;
    Centre* const last = centres + part.last;
    const int axis = longest_axis(first, last);
    const std::size_t middle = part.first + left_part(part.last - part.first);
    std::nth_element(first, centres + middle, last, [axis](const Centre& a, const Centre& b) {
      return a.at[axis] != b.at[axis] ? a.at[axis] < b.at[axis] : a.face < b.face;
    });
    divide(centres, {part.first, middle}, least, small);
    part.first = middle;
  }
  small(part);
}

}  // namespace

FacePacks::FacePacks(const Scene& scene, const Vector& lower, const Vector& upper, const Executor& executor) {
  const std::vector<std::uint32_t>& kept = scene.kept_faces();
  const Mesh& mesh = scene.mesh();
  double extent = 0;
  for (int k = 0; k < 3; ++k) {
    const double low = std::min(double{lower[k]}, double{scene.lower()[k]});
    const double high = std::max(double{upper[k]}, double{scene.upper()[k]});
    extent = std::max(extent, high - low);
  }
  scale_ = inverse_power_of_two(extent);
  places_.assign(scene.face_count(), kNoPlace);
  if (kept.empty()) return;

  std::vector<Centre> centres(kept.size());
  for_ranges(executor, kept.size(), kTaskFaces, [&](std::size_t first, std::size_t last, int) {
    for (std::size_t i = first; i < last; ++i) {
      DVector sum(0);
      for (int k = 0; k < 3; ++k) sum += DVector(mesh.vertex(kept[i], k)) - scene.centre();
      centres[i] = {kept[i], Vector(sum * scale_)};
    }
  });
  std::vector<Part> parts;
  divide(centres.data(), {0, centres.size()}, std::max(kTaskFaces, kBundleFaces),
         [&](const Part& p) { parts.push_back(p); });
  executor.for_each(parts.size(),
                    [&](std::size_t i, int) { divide(centres.data(), parts[i], kPackFaces, [](const Part&) {}); });

  packs_.resize((kept.size() + kPackFaces - 1) / kPackFaces);
  boxes_.resize((packs_.size() + kPacks - 1) / kPacks);
  bundles_.assign((boxes_.size() + kPacks - 1) / kPacks, kNoBoxes);
  last_count_ = kept.size() - (packs_.size() - 1) * kPackFaces;
  for_ranges(executor, boxes_.size(), kFewestPacks / kPacks, [&](std::size_t first, std::size_t last, int) {
    for (std::size_t p = first * kPacks; p < std::min(last * kPacks, packs_.size()); ++p) {
      std::uint32_t faces[kPackFaces];
      for (std::size_t i = 0; i < kPackFaces; ++i) faces[i] = centres[p * kPackFaces + (i < count(p) ? i : 0)].face;
      for (std::size_t i = 0; i < count(p); ++i) places_[faces[i]] = static_cast<std::uint32_t>(p * kPackFaces + i);
      fill_pack(scene, faces, p);
    }
    for (std::size_t b = first; b < last; ++b) set_boxes(b);
  });
}

void FacePacks::fill_pack(const Scene& scene, const std::uint32_t* faces, std::size_t pack) {
  simd::FacePack& to = packs_[pack];
  for (std::size_t i = 0; i < kPackFaces; ++i) {
    to.ids[i] = faces[i];
    for (int k = 0; k < 3; ++k) {
      const Vector corner = scaled(scene.mesh().vertex(faces[i], k));
      for (int j = 0; j < 3; ++j) to.corners[k][j][i] = corner[j];
    }
  }
}

// Of a bundle and of its packs.
void FacePacks::set_boxes(std::size_t bundle) {
  simd::PackBoxes& boxes = boxes_[bundle];
  boxes = kNoBoxes;
  for (int j = 0; j < 3; ++j) {
    float& bundle_lower = bundles_[bundle / kPacks].lower[j][bundle % kPacks];
    float& bundle_upper = bundles_[bundle / kPacks].upper[j][bundle % kPacks];
    for (std::size_t i = 0; i < kPacks && bundle * kPacks + i < packs_.size(); ++i) {
      float &lower = boxes.lower[j][i], &upper = boxes.upper[j][i];
      for (const auto& corner : packs_[bundle * kPacks + i].corners) {
        for (const float x : corner[j]) {
          lower = std::min(lower, x - kUnderflow);
          upper = std::max(upper, x + kUnderflow);
        }
      }
      bundle_lower = std::min(bundle_lower, lower);
      bundle_upper = std::max(bundle_upper, upper);
    }
  }
}

std::size_t FacePacks::bytes_for(const Scene& scene) {
  const std::size_t faces = scene.kept_faces().size();
  return scene.face_count() * sizeof(std::uint32_t) + (faces / kPackFaces + 1) * sizeof(simd::FacePack) +
         (faces / kBundleFaces + 1) * (sizeof(simd::PackBoxes) + sizeof(simd::PackBoxes) / kPacks + 1) +
         faces * sizeof(Centre);
}

void set_up_planes(const Scene& scene, const FacePacks& packs, std::size_t pack, const float* hub, const Vector& at,
                   simd::HubPlanes& planes) {
  const simd::FacePack& faces = packs.pack(pack);
  const std::size_t count = packs.count(pack);
  std::uint32_t open = simd::set_up_hub_planes(faces, hub, planes);
  for (std::size_t i = count; i < kPackFaces; ++i) simd::remove_plane(planes, i);
  for (open &= (1u << count) - 1; open != 0; open &= open - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(open));
    const int s = side(triangle_of(scene, faces.ids[i]), at);
    if (s < 0) simd::turn_plane(planes, i);
    if (s == 0) simd::remove_plane(planes, i);
  }
}

}  // namespace facemap
