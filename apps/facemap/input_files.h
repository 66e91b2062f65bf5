#pragma once

#include <filesystem>
#include <vector>

#include "frame_writer.h"
#include "input.h"

namespace facemap::program {

/// Throws UsageError if a file that will be written is one that was read or that the models name: a model, its
/// buffers, a texture. `save_scene` may be empty.
void check_inputs_stay(const std::vector<FrameFiles>& outputs, const std::filesystem::path& save_scene,
                       const Input& input, const Scene& scene);

/// The same for the textures of one model.
void check_images_stay(const std::filesystem::path& output, const std::vector<TextureImage>& images);

}  // namespace facemap::program
