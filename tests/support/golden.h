#pragma once

#include <facemap/renderer.h>

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

/// Pictures of 64 pixels a side that stand for all that a picture can be made of, each known by a hash: its bits are
/// the same on every machine, by both strategies, on every instruction set and number of threads.
namespace golden {

/// FNV-1a over the bytes of 32-bit words, the least significant first. All NaN count as one: files need not keep
/// others.
class Hash {
 public:
  void add(std::uint32_t bits);
  void add(std::int32_t value) { add(static_cast<std::uint32_t>(value)); }
  void add(float value);
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

/// Of the pixels and all planes that are there.
std::uint64_t hash_of(const facemap::Image& image);

/// What a picture is made of.
struct Subject {
  facemap::Model model;
  facemap::View view;
  std::vector<facemap::Light> lights;
  facemap::Renderer::Options options;
};

/// A textured dome and boxes of vertex colours on a floor; two point lights, a little sky, all planes. Material 0, of
/// dome and floor, is Material() in white; images: 0 four colours, 1 waves, 2 holes (its alpha).
Subject make_subject();

struct Golden {
  const char* name;
  std::uint64_t hash;
  std::function<void(Subject&)> change;
};

/// Expects the hash from pictures of a scene in every way of making them; a failure prints the table's new line.
void expect_hash(const char* name, std::uint64_t hash, const facemap::Scene& scene, const Subject& subject);

/// The same of each line of a table, and that no two pictures are the same: what is changed is seen.
void expect_hashes(std::span<const Golden> table);

}  // namespace golden
