#include <facemap/error.h>
#include <facemap/generators.h>

#include "scene/generators/scene_builder.h"

namespace facemap {
namespace {

struct Generator {
  std::string_view name;
  GeneratedScene (*make)(int detail);
};

constexpr Generator kGenerators[] = {
    {"chessboard", generators::make_chessboard},
    {"grass", generators::make_grass},
    {"bust", generators::make_bust},
    {"typewriter", generators::make_typewriter},
};

}  // namespace

std::vector<std::string> generator_names() {
  std::vector<std::string> names;
  for (const Generator& generator : kGenerators) names.emplace_back(generator.name);
  return names;
}

GeneratedScene generate_scene(std::string_view name, int detail) {
  if (detail < 1 || detail > kMaxSceneDetail) {
    throw Error("detail " + std::to_string(detail) + " is not in 1.." + std::to_string(kMaxSceneDetail));
  }
  for (const Generator& generator : kGenerators) {
    if (generator.name == name) return generator.make(detail);
  }
  std::string known;
  for (const Generator& generator : kGenerators) known += (known.empty() ? "" : ", ") + std::string(generator.name);
  throw Error("no scene called '" + std::string(name) + "'; there are " + known);
}

}  // namespace facemap
