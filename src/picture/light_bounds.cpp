#include "picture/light_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "picture/face_spots.h"
#include "picture/face_texels.h"
#include "picture/gnomonic.h"
#include "picture/light_patches.h"
#include "simd/shadow_faces.h"

namespace facemap {
namespace {

// Texels a side: a raster has more texels than there are faces up to the usual size, and fewer beyond it.
constexpr int kLeastSize = 64, kUsualSize = 512, kMostSize = 2048;

// Faces are listed if they are at most this share of all: a list costs memory and order.
constexpr double kWorthListing = 0.7;

// The boxes of all faces may have so many texels: for each face, and times the whole raster.
constexpr std::size_t kMostBoxTexels = 200, kMostLayers = 64;

// A light's bounds and lists together take so many bytes a face: lists that would need more are left out. Eight lights
// take three times what a hierarchy of boxes does, which serves all lights.
constexpr std::size_t kMostBytesPerFace = 26;
constexpr std::size_t kUsualBytes = std::size_t{1} << 18;  // which are little however few the faces
constexpr std::size_t kBytesPerEntry = 6;

// Coordinates of vertices on the raster are within this, or the bounds of FaceTexels would not hold.
constexpr float kFarthestPlace = 1.25f;

int size_for(std::size_t faces) {
  const auto texels = [](int size) { return static_cast<std::size_t>(size) * static_cast<std::size_t>(size); };
  int size = kLeastSize;
  while (size < kUsualSize && texels(size) < faces) size *= 2;
  while (size < kMostSize && texels(2 * size) <= faces) size *= 2;
  return size;
}

bool is_on_raster(const float* place) {
  return place[2] > 0 && std::fabs(place[0]) <= kFarthestPlace && std::fabs(place[1]) <= kFarthestPlace;
}

// The kept faces, as offsets from the light.
OffsetBox box_of_faces(const Scene& scene, const Vector& light) {
  OffsetBox box{DVector(HUGE_VAL), DVector(-HUGE_VAL)};
  for (const std::uint32_t face : scene.kept_faces()) {
    for (int k = 0; k < 3; ++k) {
      const DVector offset = DVector(scene.mesh().vertex(face, k)) - DVector(light);
      for (int axis = 0; axis < 3; ++axis) {
        box.lower[axis] = std::min(box.lower[axis], offset[axis]);
        box.upper[axis] = std::max(box.upper[axis], offset[axis]);
      }
    }
  }
  return box;
}

}  // namespace

class LightBounds::Finder {
 public:
  Finder(const Scene& scene, const std::uint8_t* skip_entries, const simd::ShadowFrame& frame, LightBounds& bounds)
      : scene_(scene), skip_entries_(skip_entries), bounds_(bounds), places_(3 * (scene.mesh().positions.size() + 16)) {
    const std::vector<Vector>& positions = scene.mesh().positions;
    simd::project_vertices(frame, &positions[0].x, positions.size(), places_.data());
    bounds_.frame_ = frame;
    bounds_.size_ = size_for(scene.kept_faces().size());
  }

  bool find(const std::vector<FaceNeighbours>& neighbours, bool wants_lists) {
    if (!find_scale() || is_too_much()) return false;
    const std::vector<float> lit = find_lit();
    encode(lit, find_dark(scene_, neighbours, places_, bounds_.size_));
    if (wants_lists) find_lists();
    if (!bounds_.lists_.any()) find_faces();
    return true;
  }

 private:
  const float* place(std::uint32_t face, std::size_t k) const {
    return places_.data() + 3 * std::size_t{scene_.mesh().triangles[face][k]};
  }

  // Of the faces that may have to be asked.
  template <class Visit>
  void for_each_face(const Visit& visit) const {
    for (const std::uint32_t face : scene_.kept_faces()) {
      const FaceTexels texels(place(face, 0), place(face, 1), place(face, 2), bounds_.size_);
      if (texels.side() < 0 && skip_entries_ != nullptr && skip_entries_[face] != 0) continue;
      visit(face, texels);
    }
  }

  // False if some face is where FaceTexels can't tell its texels.
  bool find_scale() {
    float least = std::numeric_limits<float>::infinity(), greatest = 0;
    for (const std::uint32_t face : scene_.kept_faces()) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (!is_on_raster(place(face, k))) return false;
        least = std::min(least, place(face, k)[2]);
        greatest = std::max(greatest, place(face, k)[2]);
      }
    }
    bounds_.w_least_ = least;
    bounds_.w_greatest_ = greatest * (simd::kShadowDepthFactor * simd::kShadowDepthFactor);
    // The last step is for points in front of all faces.
    bounds_.w_scale_ = (simd::TexelBounds::kSteps - 1) / (bounds_.w_greatest_ - least);
    return true;
  }

  // Whether the faces lie over each other so often that the bounds would take long.
  bool is_too_much() const {
    const std::size_t faces = scene_.kept_faces().size();
    std::size_t left = kMostBoxTexels * faces + kMostLayers * texel_count();
    for (const std::uint32_t face : scene_.kept_faces()) {
      const std::size_t size = FaceTexels(place(face, 0), place(face, 1), place(face, 2), bounds_.size_).box_size();
      if (size > left) return true;
      left -= size;
    }
    return false;
  }

  std::size_t texel_count() const {
    return static_cast<std::size_t>(bounds_.size_) * static_cast<std::size_t>(bounds_.size_);
  }

  std::vector<float> find_lit() const {
    std::vector<float> lit(texel_count(), 0.0f);
    for_each_face([&](std::uint32_t, const FaceTexels& texels) {
      texels.for_each(
          [&](const FaceTexels::Piece& piece) { lit[piece.texel] = std::max(lit[piece.texel], piece.greatest); });
    });
    return lit;
  }

  // Monotone in w, however it is rounded: of two numbers that differ it is known which w is greater.
  float number(float w) const {
    return std::clamp((w - bounds_.w_least_) * bounds_.w_scale_, 0.0f, simd::TexelBounds::kSteps);
  }

  void encode(const std::vector<float>& lit, const std::vector<float>& dark) {
    bounds_.texels_.resize(lit.size());
    for (std::size_t t = 0; t < lit.size(); ++t) {
      const auto upper = lit[t] > 0 ? std::max(static_cast<std::uint32_t>(std::ceil(number(lit[t]))), 1u) : 0u;
      const auto lower = dark[t] > 0 ? static_cast<std::uint32_t>(std::floor(number(dark[t]))) : 0u;
      bounds_.texels_[t] = upper << 16 | lower;
    }
  }

  // Leaves out faces that in each of their texels are behind what is dark: a point that such a face blocks is dark.
  // It has to be told so by its texel: what makes it dark may be entry faces, which are not listed either.
  void find_faces() {
    std::vector<std::uint32_t> faces;
    for_each_face([&](std::uint32_t face, const FaceTexels& texels) {
      bool is_needed = false;
      texels.for_each([&](const FaceTexels::Piece& piece) {
        is_needed = is_needed || number(piece.greatest) >= static_cast<float>(bounds_.texels_[piece.texel] & 0xffff);
      });
      if (is_needed) faces.push_back(face);
    });
    bounds_.has_faces_ = static_cast<double>(faces.size()) < kWorthListing * static_cast<double>(scene_.face_count());
    if (bounds_.has_faces_) bounds_.faces_.assign(faces.begin(), faces.end());
  }

  // Where texels have too many faces, of four texels together.
  void find_lists() {
    for (int size = bounds_.size_; size >= bounds_.size_ / 2 && !bounds_.lists_.any(); size /= 2) {
      const std::size_t texels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
      const std::size_t taken = 4 * texel_count() + 9 * texels / 4,
                        most = std::max(kMostBytesPerFace * scene_.face_count(), kUsualBytes);
      TexelLists::Maker maker(size, scene_.face_count(), most > taken ? (most - taken) / kBytesPerEntry : 0);
      if (fill_lists(size, maker)) bounds_.lists_ = maker.take();
    }
  }

  // Faces that a point may have to ask which its texel leaves open; the others are behind what is dark there.
  bool fill_lists(int size, TexelLists::Maker& maker) const {
    bool has_room = true;
    for_each_face([&](std::uint32_t face, const FaceTexels& on_bounds) {
      if (!has_room) return;
      const float *a = place(face, 0), *b = place(face, 1), *c = place(face, 2);
      std::optional<FaceSpots> of_face;
      (size == bounds_.size_ ? on_bounds : FaceTexels(a, b, c, size)).for_each([&](const FaceTexels::Piece& piece) {
        const float depth = number(piece.greatest);
        const unsigned open = open_spots(piece.texel, size, depth);
        if (open == 0) return;
        if (!of_face) of_face.emplace(FaceTexels(a, b, c, simd::kTexelSpots * size), size);
        const unsigned spots = of_face->in(piece.texel) & open;
        if (spots != 0) has_room = has_room && maker.add(piece.texel, face, static_cast<std::uint32_t>(depth), spots);
      });
    });
    return has_room;
  }

  // Whether a point that this texel leaves open may be behind a face of such a depth.
  bool is_open(std::size_t texel, float depth) const {
    const std::uint32_t upper = bounds_.texels_[texel] >> 16, lower = bounds_.texels_[texel] & 0xffff;
    return upper >= lower && depth >= static_cast<float>(lower);
  }

  // The spots of a texel of lists where that is so.
  unsigned open_spots(std::size_t texel, int size, float depth) const {
    static_assert(simd::kTexelSpots == 4);
    if (size == bounds_.size_) return is_open(texel, depth) ? 0xffff : 0;
    const std::size_t row = texel / static_cast<std::size_t>(size), column = texel % static_cast<std::size_t>(size);
    unsigned open = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t quarter = (2 * row + k / 2) * static_cast<std::size_t>(bounds_.size_) + 2 * column + k % 2;
      if (is_open(quarter, depth)) open |= 0x0033u << (8 * (k / 2) + 2 * (k % 2));
    }
    return open;
  }

  const Scene& scene_;
  const std::uint8_t* skip_entries_;
  LightBounds& bounds_;
  std::vector<float> places_;  // of the vertices
};

std::optional<LightBounds> LightBounds::find(const Scene& scene, const Vector& light, const std::uint8_t* skip_entries,
                                             const std::vector<FaceNeighbours>& neighbours, bool wants_lists) {
  if (scene.kept_faces().empty()) return {};
  const auto frame = frame_towards(light, box_of_faces(scene, light), 0);
  if (!frame) return {};
  LightBounds bounds;
  if (!Finder(scene, skip_entries, *frame, bounds).find(neighbours, wants_lists)) return {};
  return bounds;
}

}  // namespace facemap
