#include "model.h"

#include "input.h"
#include "report.h"
#include "usage_error.h"

namespace facemap::program {

Scene load_model(const std::filesystem::path& path, bool quiet, int threads) {
  if (path.empty()) throw UsageError("no model is given");
  Scene scene = is_standard_input(path)
                    ? Scene(parse_model(read_standard_input(ModelLimits().max_bytes), "standard input"), threads)
                    : Scene::load(path, threads);
  if (quiet) return scene;
  for (const std::string& warning : scene.report().warnings) warn(warning);
  if (scene.kept_faces().empty()) warn(path.string() + ": no face has an area");
  return scene;
}

}  // namespace facemap::program
