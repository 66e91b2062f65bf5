#include "picture/light_patches.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "picture/face_texels.h"

namespace facemap {
namespace {

// Faces of a patch stand side by side.
struct Patches {
  std::vector<std::uint32_t> faces;
  std::vector<std::uint32_t> begins;  // one more at the end
};

class PatchFinder {
 public:
  PatchFinder(const Scene& scene, const std::vector<FaceNeighbours>& neighbours, const std::vector<std::int8_t>& sides)
      : scene_(scene), neighbours_(neighbours), sides_(sides), parents_(scene.face_count()) {}

  Patches find() {
    std::iota(parents_.begin(), parents_.end(), 0u);
    for (const std::uint32_t face : scene_.kept_faces()) {
      for (const std::uint32_t other : neighbours_[face]) {
        if (other < face && sides_[face] != 0 && sides_[other] == sides_[face]) join(face, other);
      }
    }
    // By the least face of each patch.
    Patches patches;
    std::vector<std::uint32_t> counts(parents_.size() + 1, 0);
    for (const std::uint32_t face : scene_.kept_faces()) {
      if (sides_[face] != 0) ++counts[root(face) + 1];
    }
    std::partial_sum(counts.begin(), counts.end(), counts.begin());
    patches.faces.resize(counts.back());
    patches.begins.push_back(0);
    for (std::size_t face = 0; face < parents_.size(); ++face) {
      if (counts[face + 1] > counts[face]) patches.begins.push_back(counts[face + 1]);
    }
    for (const std::uint32_t face : scene_.kept_faces()) {
      if (sides_[face] != 0) patches.faces[counts[root(face)]++] = face;
    }
    return patches;
  }

 private:
  std::uint32_t root(std::uint32_t face) {
    while (parents_[face] != face) face = parents_[face] = parents_[parents_[face]];
    return face;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }

  const Scene& scene_;
  const std::vector<FaceNeighbours>& neighbours_;
  const std::vector<std::int8_t>& sides_;
  std::vector<std::uint32_t> parents_;
};

struct Box {
  int column0, column1, row0, row1;
};

// Holds one patch at a time against the texels.
class PatchTexels {
 public:
  explicit PatchTexels(int size)
      : size_(size),
        least_(static_cast<std::size_t>(size) * static_cast<std::size_t>(size)),
        marks_(least_.size()),
        dark_(least_.size(), 0.0f) {}

  void begin(const Box& box) {
    box_ = box;
    for (int row = box.row0; row <= box.row1; ++row) {
      std::fill_n(least_.begin() + static_cast<std::ptrdiff_t>(texel(box.column0, row)), width(),
                  std::numeric_limits<float>::infinity());
      std::fill_n(marks_.begin() + static_cast<std::ptrdiff_t>(texel(box.column0, row)), width(), std::uint8_t{0});
    }
  }

  // `middle`: the computed place of some point of the face.
  void add_face(const FaceTexels& face, float middle_u, float middle_v) {
    face.for_each([&](const FaceTexels::Piece& piece) {
      least_[piece.texel] = std::min(least_[piece.texel], piece.least);
      if (piece.is_within) marks_[piece.texel] |= kCovered;
    });
    marks_[texel(texel_of(middle_u, size_), texel_of(middle_v, size_))] |= kCovered;
  }

  // Of the patch: not between two of its faces.
  void add_border(const float* a, const float* b) {
    FaceTexels(a, b, b, size_).for_each([&](const FaceTexels::Piece& piece) { marks_[piece.texel] |= kBorder; });
  }

  void end() {
    spread();
    for (int row = box_.row0; row <= box_.row1; ++row) {
      for (std::size_t t = texel(box_.column0, row); t <= texel(box_.column1, row); ++t) {
        if (marks_[t] == kCovered && least_[t] < std::numeric_limits<float>::infinity()) {
          dark_[t] = std::max(dark_[t], least_[t]);
        }
      }
    }
  }

  std::vector<float> take() { return std::move(dark_); }

 private:
  static constexpr std::uint8_t kBorder = 1, kCovered = 2;

  std::size_t texel(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(size_) + static_cast<std::size_t>(column);
  }
  int width() const { return box_.column1 - box_.column0 + 1; }

  // Texels side by side without a border share the directions between them, so both are covered or neither is.
  void spread() {
    const auto size = static_cast<std::size_t>(size_);
    const auto take_over = [&](std::size_t to, std::size_t from) {
      if (marks_[from] == kCovered && marks_[to] == 0) marks_[to] = kCovered;
    };
    for (int row = box_.row0; row <= box_.row1; ++row) {
      for (int column = box_.column0; column <= box_.column1; ++column) {
        const std::size_t t = texel(column, row);
        if (column > box_.column0) take_over(t, t - 1);
        if (row > box_.row0) take_over(t, t - size);
      }
    }
    for (int row = box_.row1; row >= box_.row0; --row) {
      for (int column = box_.column1; column >= box_.column0; --column) {
        const std::size_t t = texel(column, row);
        if (column < box_.column1) take_over(t, t + 1);
        if (row < box_.row1) take_over(t, t + size);
      }
    }
  }

  int size_;
  Box box_{};
  std::vector<float> least_;  // w of the patch's faces in a texel
  std::vector<std::uint8_t> marks_;
  std::vector<float> dark_;
};

}  // namespace

std::vector<float> find_dark(const Scene& scene, const std::vector<FaceNeighbours>& neighbours,
                             const std::vector<float>& places, int size) {
  const Mesh& mesh = scene.mesh();
  const auto place = [&](std::uint32_t face, std::size_t k) {
    return places.data() + 3 * std::size_t{mesh.triangles[face][k]};
  };
  const auto texels = [&](std::uint32_t face) {
    return FaceTexels(place(face, 0), place(face, 1), place(face, 2), size);
  };
  std::vector<std::int8_t> sides(scene.face_count(), 0);
  for (const std::uint32_t face : scene.kept_faces()) sides[face] = static_cast<std::int8_t>(texels(face).side());
  const Patches patches = PatchFinder(scene, neighbours, sides).find();

  PatchTexels on_texels(size);
  for (std::size_t p = 0; p + 1 < patches.begins.size(); ++p) {
    const auto begin = patches.faces.begin() + patches.begins[p], end = patches.faces.begin() + patches.begins[p + 1];
    Box box{size, -1, size, -1};
    std::for_each(begin, end, [&](std::uint32_t face) {
      const FaceTexels t = texels(face);
      box = {std::min(box.column0, t.column0()), std::max(box.column1, t.column1()), std::min(box.row0, t.row0()),
             std::max(box.row1, t.row1())};
    });
    // Some border crosses every texel of a patch that is as narrow as this.
    if (box.column1 - box.column0 < 2 || box.row1 - box.row0 < 2) continue;
    on_texels.begin(box);
    std::for_each(begin, end, [&](std::uint32_t face) {
      const float *a = place(face, 0), *b = place(face, 1), *c = place(face, 2);
      on_texels.add_face(texels(face), (a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3);
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t other = neighbours[face][k];
        if (other == kNoNeighbour || sides[other] != sides[face]) {
          on_texels.add_border(place(face, k), place(face, (k + 1) % 3));
        }
      }
    });
    on_texels.end();
  }
  return on_texels.take();
}

}  // namespace facemap
