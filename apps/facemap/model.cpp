#include "model.h"

#include <iostream>

#include "usage_error.h"

namespace facemap::program {

Scene load_model(const std::filesystem::path& path, bool quiet, int threads) {
  if (path.empty()) throw UsageError("no model is given");
  Scene scene = Scene::load(path, threads);
  if (quiet) return scene;
  for (const std::string& warning : scene.report().warnings) std::cerr << "facemap: warning: " << warning << '\n';
  if (scene.kept_faces().empty()) std::cerr << "facemap: warning: " << path.string() << ": no face has an area\n";
  return scene;
}

}  // namespace facemap::program
