#include "input_files.h"

#include <set>

#include "output.h"
#include "usage_error.h"

namespace facemap::program {
namespace {

namespace fs = std::filesystem;

/// What a run must leave as it is: files by the names that the file system has for them.
class InputFiles {
 public:
  explicit InputFiles(const std::vector<TextureImage>& images) {
    for (const TextureImage& image : images) {
      if (!image.file.empty()) names_.insert(settled_name(image.file));
    }
  }

  InputFiles(const Input& input, const Scene& scene) : InputFiles(scene.images()) {
    for (const SceneModel& model : input.scene.models) {
      if (!is_standard_input(model.path)) names_.insert(settled_name(model.path));
      has_buffers_ = has_buffers_ || model.path.extension() == ".gltf";
    }
  }

  void check(const fs::path& output) const {
    std::error_code ignored;
    if (output.empty() || is_standard_output(output) || !fs::exists(output, ignored)) return;
    if (names_.count(settled_name(output)) > 0 || (has_buffers_ && output.extension() == ".bin"))
      throw UsageError(output.string() + ": the output would replace a file that the model needs");
  }

 private:
  std::set<fs::path> names_;
  bool has_buffers_ = false;  ///< a glTF file may name files of its own for numbers, .bin by custom
};

}  // namespace

void check_images_stay(const fs::path& output, const std::vector<TextureImage>& images) {
  InputFiles(images).check(output);
}

void check_inputs_stay(const std::vector<FrameFiles>& outputs, const fs::path& save_scene, const Input& input,
                       const Scene& scene) {
  const InputFiles inputs(input, scene);
  for (const FrameFiles& frame : outputs) {
    inputs.check(frame.picture);
    for (const PlaneFile& plane : frame.planes) inputs.check(plane.file);
  }
  inputs.check(save_scene);
}

}  // namespace facemap::program
