#include "scene/stl_binary.h"

#include <facemap/error.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>

#include "scene/colour_materials.h"
#include "scene/stl_mesh.h"

namespace facemap {

namespace {

using Cause = LoadError::Cause;

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t kAttributeOffset = 48;
constexpr std::uint16_t kTopBit = 0x8000;

std::uint16_t attribute(const char* facet) {
  std::uint16_t word;
  std::memcpy(&word, facet + kAttributeOffset, sizeof word);
  return word;
}

bool is_finite(const Vector& v) {
  // Not finite less itself is NaN.
  return (v.x - v.x) + (v.y - v.y) + (v.z - v.z) == 0;
}

std::uint32_t rgb_of(unsigned red, unsigned green, unsigned blue) { return red << 16 | green << 8 | blue; }

/// Of five bits each.
std::uint32_t rgb_of_levels(unsigned red, unsigned green, unsigned blue) {
  const auto widened = [](unsigned level) { return ((level & 31) * 255 + 15) / 31; };
  return rgb_of(widened(red), widened(green), widened(blue));
}

/// How many facets to read: where the count and the size disagree, what the size says.
std::size_t facets_of(std::string_view bytes, const std::string& name, ObjWarnings& warnings) {
  if (bytes.size() < kStlHeaderSize) {
    throw LoadError(Cause::TruncatedStatement, name, 0,
                    "too short for a binary STL file, and no text that begins with \"solid\"");
  }
  const std::size_t body = bytes.size() - kStlHeaderSize, whole = body / kStlFacetSize;
  const std::size_t stated = stl_facet_count(bytes);
  if (stated == whole && body % kStlFacetSize == 0) return stated;
  const std::string disagreement = std::to_string(stated) + " stated, room for " + std::to_string(whole);
  // Some programs put data of their own behind the facets.
  if (stated != 0 && stated <= whole && body % kStlFacetSize != 0) {
    warnings.add(0, "bytes behind the facets, ignored", disagreement);
    return stated;
  }
  warnings.add(0, "the count of facets is not what the file's size says, which counts", disagreement);
  return whole;
}

/// Colours that some programs write in the attributes' 16 bits. Magics says so in the header ("COLOR=" and the
/// object's colour): 5 bits each of red (the lowest), green and blue; the top bit marks facets of the object's colour.
/// VisCAM and SolidView have blue lowest, and the top bit marks facets that have a colour. Without such signs the bits
/// may mean anything.
class FacetColours {
 public:
  FacetColours(std::string_view bytes, std::size_t facets, ObjWarnings& warnings) {
    std::uint16_t all_marked = 0xffff, any = 0;  // of the attributes that are not 0
    for (std::size_t i = 0; i != facets; ++i) {
      const std::uint16_t word = attribute(bytes.data() + kStlHeaderSize + i * kStlFacetSize);
      if (word != 0) all_marked &= word;
      any |= word;
    }
    constexpr std::string_view kMark = "COLOR=";
    const std::size_t mark = bytes.substr(0, 80 - 4).find(kMark);
    if (mark != std::string_view::npos && mark + kMark.size() + 4 <= 80) {
      const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[mark + kMark.size() + i]); };
      object_ = rgb_of(byte(0), byte(1), byte(2));
      kind_ = any == 0 ? Kind::Object : Kind::Magics;
    } else if (any != 0 && (all_marked & kTopBit) != 0) {
      kind_ = Kind::VisCam;
    } else if (any != 0) {
      warnings.add(0, "attributes that are not colours of a known kind, ignored");
    }
  }

  bool any() const { return kind_ != Kind::None; }

  /// 0xRRGGBB, or none.
  std::optional<std::uint32_t> of(std::uint16_t word) const {
    const unsigned low = word & 31u, middle = word >> 5 & 31u, high = word >> 10 & 31u;
    const bool is_marked = (word & kTopBit) != 0;
    switch (kind_) {
      case Kind::None:
        break;
      case Kind::Object:
        return object_;
      case Kind::Magics:
        return is_marked ? object_ : rgb_of_levels(low, middle, high);
      case Kind::VisCam:
        if (is_marked) return rgb_of_levels(high, middle, low);
        break;
    }
    return std::nullopt;
  }

 private:
  enum class Kind { None, Object, Magics, VisCam };

  Kind kind_ = Kind::None;
  std::uint32_t object_ = 0;
};

}  // namespace

std::uint32_t stl_facet_count(std::string_view bytes) {
  std::uint32_t count;
  std::memcpy(&count, bytes.data() + kStlHeaderSize - sizeof count, sizeof count);
  return count;
}

void read_stl_binary(std::string_view bytes, const std::string& name, const ModelLimits& limits, StlMesh& mesh,
                     Model& model, ObjWarnings& warnings) {
  const std::size_t facets = facets_of(bytes, name, warnings);
  if (facets > limits.max_faces || facets > StlMesh::kMostFacets) {
    throw LoadError(Cause::TooLarge, name, 0,
                    "more than " + std::to_string(std::min(limits.max_faces, StlMesh::kMostFacets)) + " triangles");
  }
  const FacetColours colours(bytes, facets, warnings);
  ColourMaterials materials(model.materials);
  mesh.reserve(facets);
  for (std::size_t i = 0; i != facets; ++i) {
    const char* const facet = bytes.data() + kStlHeaderSize + i * kStlFacetSize;
    Vector vectors[4];  // the normal first
    std::memcpy(vectors, facet, sizeof vectors);
    if (!is_finite(vectors[1]) || !is_finite(vectors[2]) || !is_finite(vectors[3])) {
      throw LoadError(Cause::BadNumber, name, 0, "facet " + std::to_string(i) + " (from 0): a vertex is not finite");
    }
    mesh.add(vectors + 1, vectors[0]);
    if (colours.any()) {
      const std::optional<std::uint32_t> rgb = colours.of(attribute(facet));
      model.mesh.triangle_materials.push_back(rgb ? materials.of(*rgb) : kNoIndex);
    }
  }
}

}  // namespace facemap
