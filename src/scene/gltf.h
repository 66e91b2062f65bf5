#pragma once

#include <facemap/model.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace facemap {

/// Reads a glTF 2.0 file, JSON or GLB: the nodes of its scene as one mesh in world coordinates, its materials, the
/// images that they use, its lights and cameras. Buffers and images beside the file are looked up below `directory`
/// (empty: nowhere). docs/scenes.md says what is read. Throws LoadError.
Model read_gltf(std::string_view bytes, const std::string& name, const std::filesystem::path& directory,
                const ModelLimits& limits = {});

}  // namespace facemap
