#include "material/texture_set.h"

#include <facemap/error.h>

#include <new>

#include "scene/read_texture.h"

namespace facemap {

TextureSet::TextureSet(const Scene& scene, std::uint64_t max_pixels, const Executor& executor) {
  const auto need = [&](const TextureUse& use, Encoding encoding) {
    if (use.is_used()) textures_.try_emplace({use.image, encoding});
  };
  for (const Material& m : scene.materials()) {
    need(m.diffuse_map, encoding_of_diffuse(m));
    for (const TextureUse* use : {&m.specular_map, &m.emission_map}) need(*use, Encoding::Srgb);
    for (const TextureUse* use : {&m.shininess_map, &m.metallic_map, &m.roughness_map, &m.normal_map, &m.bump_map}) {
      need(*use, Encoding::Linear);
    }
  }
  struct Task {
    const Key& key;
    std::unique_ptr<const Texture>& texture;
    std::string warning;
  };
  std::vector<Task> tasks;
  for (auto& [key, texture] : textures_) tasks.push_back({key, texture, {}});
  executor.for_each(tasks.size(), [&](std::size_t i, int) {
    const TextureImage& image = scene.images()[tasks[i].key.first];
    try {
      tasks[i].texture = std::make_unique<Texture>(read_texture(image, max_pixels), tasks[i].key.second);
    } catch (const Error& error) {
      tasks[i].warning = error.what();
    } catch (const std::bad_alloc&) {
      tasks[i].warning = image.name + ": not enough memory for the image";
    }
  });
  for (const Task& task : tasks) {
    if (!task.warning.empty() && (warnings_.empty() || warnings_.back() != task.warning)) {
      warnings_.push_back(task.warning);
    }
  }
}

const Texture* TextureSet::find(const TextureUse& use, Encoding encoding) const {
  const auto found = textures_.find({use.image, encoding});
  return found == textures_.end() ? nullptr : found->second.get();
}

}  // namespace facemap
