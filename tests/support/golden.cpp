#include "support/golden.h"

#include <gtest/gtest.h>

#include <bit>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <map>
#include <type_traits>

#include "simd/target.h"

namespace golden {
namespace {

using namespace facemap;

template <class Element>
void add_elements(Hash& hash, const std::vector<Element>& elements) {
  for (const Element& element : elements) {
    if constexpr (std::is_same_v<Element, Color>) {
      for (const float channel : {element.r, element.g, element.b}) hash.add(channel);
    } else if constexpr (std::is_same_v<Element, std::uint8_t>) {
      hash.add(std::uint32_t{element});
    } else if constexpr (std::is_arithmetic_v<Element>) {
      hash.add(element);
    } else {
      for (int i = 0; i < Element::length(); ++i) hash.add(element[i]);
    }
  }
}

std::string line_of(const char* name, std::uint64_t hash) {
  char text[32];
  std::snprintf(text, sizeof text, "0x%016" PRIx64, hash);
  return "{\"" + std::string(name) + "\", " + text + ",";
}

const char* name_of(Renderer::Strategy strategy) {
  return strategy == Renderer::Strategy::Lists ? "lists" : "transposed";
}

/// Leaves the kernels' target as it was.
class TargetGuard {
 public:
  ~TargetGuard() { simd::set_active_target(before_); }

 private:
  simd::Target before_ = simd::active_target();
};

}  // namespace

void Hash::add(std::uint32_t bits) {
  for (int shift = 0; shift < 32; shift += 8) value_ = (value_ ^ (bits >> shift & 255)) * 0x100000001b3u;
}

void Hash::add(float value) { add(std::isnan(value) ? 0x7fc00000u : std::bit_cast<std::uint32_t>(value)); }

std::uint64_t hash_of(const Image& image) {
  Hash hash;
  hash.add(image.width);
  hash.add(image.height);
  add_elements(hash, image.pixels);
  add_elements(hash, image.ids);
  add_elements(hash, image.depths);
  add_elements(hash, image.zs);
  add_elements(hash, image.positions);
  add_elements(hash, image.normals);
  add_elements(hash, image.face_normals);
  add_elements(hash, image.albedos);
  add_elements(hash, image.uvs);
  add_elements(hash, image.objects);
  add_elements(hash, image.materials);
  add_elements(hash, image.lights);
  add_elements(hash, image.shadows);
  return hash.value();
}

void expect_hash(const char* name, std::uint64_t hash, const Scene& scene, const Subject& subject) {
  const TargetGuard guard;
  for (const simd::Target target : simd::supported_targets()) {
    simd::set_active_target(target);
    for (const auto strategy : {Renderer::Strategy::Lists, Renderer::Strategy::Transposed}) {
      for (const int threads : {1, 3}) {
        Renderer::Options options = subject.options;
        options.strategy = strategy;
        options.threads = threads;
        const std::uint64_t found = hash_of(Renderer(scene, subject.view, subject.lights, options).render());
        EXPECT_EQ(found, hash) << simd::name_of(target) << ", " << name_of(strategy) << ", " << threads
                               << " threads; the table's line would be\n"
                               << line_of(name, found);
      }
    }
  }
}

void expect_hashes(std::span<const Golden> table) {
  std::map<std::uint64_t, std::string> names;
  for (const Golden& golden : table) {
    SCOPED_TRACE(golden.name);
    Subject subject = make_subject();
    golden.change(subject);
    const Scene scene(subject.model);
    expect_hash(golden.name, golden.hash, scene, subject);
    const auto [other, is_new] = names.emplace(golden.hash, golden.name);
    EXPECT_TRUE(is_new) << "the same picture as " << other->second;
  }
}

}  // namespace golden
