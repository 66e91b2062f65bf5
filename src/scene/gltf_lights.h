#pragma once

#include <facemap/light.h>

#include <optional>

#include "scene/gltf_nodes.h"

namespace facemap {

/// The light of KHR_lights_punctual that stands at a node, if there is one. Throws LoadError if the node names a light
/// that is not there; what is odd about one is a warning.
std::optional<Light> read_gltf_light(const GltfFile& file, const GltfNode& node);

/// The camera that stands at a node, if there is one.
std::optional<ModelCamera> read_gltf_camera(const GltfFile& file, const GltfNode& node);

}  // namespace facemap
