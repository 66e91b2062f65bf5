#include "scene/mtl.h"

#include <algorithm>
#include <cmath>

#include "scene/mtl_texture.h"
#include "scene/number.h"
#include "scene/obj_lines.h"

namespace facemap {

namespace {

bool at_end(const char* at) { return *at == '\n' || *at == '#'; }

std::string_view token_at(const char* at) { return {at, static_cast<std::size_t>(skip_token(at) - at)}; }

/// What a material's statements said, as far as that decides what others mean.
struct Stated {
  bool opacity = false, metallic = false, roughness = false;
  bool diffuse_map = false;  ///< even one that is not there
};

/// A colour of zero would hide its texture: writers that put it there mean the texture alone.
void show(bool has_map, Vector& colour) {
  if (has_map && colour == Vector(0)) colour = Vector(1);
}

/// The roughness whose highlight is about as wide as a Blinn-Phong one: alpha^2 = 2 / (Ns + 2), alpha = roughness^2.
float roughness_of(float shininess) { return std::sqrt(std::sqrt(2 / (std::max(0.0f, shininess) + 2))); }

/// Settles what follows from a material's statements together.
void complete(const Stated& stated, Material& material) {
  show(stated.diffuse_map, material.diffuse);
  show(material.specular_map.is_used(), material.specular);
  show(material.emission_map.is_used(), material.emission);
  const bool is_metal_rough =
      stated.metallic || stated.roughness || material.metallic_map.is_used() || material.roughness_map.is_used();
  if (is_metal_rough) {
    material.kind = Material::Kind::MetalRough;
    if (!stated.metallic) material.metallic = material.metallic_map.is_used() ? 1.0f : 0.0f;
    if (!stated.roughness) {
      material.roughness = material.roughness_map.is_used() ? 1.0f : roughness_of(material.shininess);
    }
  }
  if (material.shininess_map.is_used() && material.shininess == 0) material.shininess = 1;
  material.is_unlit = material.illumination == 0;
  if (material.opacity_map.is_used()) {
    material.alpha = Material::Alpha::Mask;
  } else if (material.opacity < 1) {
    material.alpha = Material::Alpha::Blend;
  }
}

/// Reads the statements of one MTL file.
class MtlReader {
 public:
  MtlReader(std::string_view text, const std::filesystem::path& folder, ImageTable& images, ObjWarnings& warnings,
            std::vector<Material>& materials)
      : lines_(text),
        folder_(folder),
        images_(images),
        warnings_(warnings),
        materials_(materials),
        first_(materials.size()) {}

  void read() {
    while (lines_.next()) {
      const char* const at = skip_blanks(lines_.begin());
      if (!at_end(at)) read_statement(token_at(at), skip_token(at));
    }
    end_material();
    show_invisible();
  }

 private:
  void read_statement(std::string_view keyword, const char* at) {
    if (keyword == "newmtl") {
      end_material();
      materials_.emplace_back().name = rest_of_line(at);
      stated_ = {};
    } else if (materials_.size() == first_) {
      warnings_.add(lines_.number(), "statement before the first newmtl", keyword);
    } else if (TextureUse* const use = texture_of(materials_.back(), keyword)) {
      read_texture(at, *use);
    } else {
      read_property(materials_.back(), keyword, at);
    }
  }

  void end_material() {
    if (materials_.size() == first_) return;
    complete(stated_, materials_.back());
  }

  /// Where nothing at all would be seen the writer had d and Tr the wrong way round.
  void show_invisible() {
    const auto is_invisible = [](const Material& material) { return material.opacity <= 0; };
    const auto begin = materials_.begin() + static_cast<std::ptrdiff_t>(first_);
    if (begin == materials_.end() || !std::all_of(begin, materials_.end(), is_invisible)) return;
    warnings_.add(opacity_line_, "all materials are invisible (d 0 or Tr 1); they are taken as opaque");
    std::for_each(begin, materials_.end(), [](Material& material) {
      material.opacity = 1;
      if (material.alpha == Material::Alpha::Blend) material.alpha = Material::Alpha::Opaque;
    });
  }

  void read_property(Material& material, std::string_view keyword, const char* at) {
    if (keyword == "Ka") {
      read_colour(at, material.ambient);
    } else if (keyword == "Kd") {
      read_colour(at, material.diffuse);
    } else if (keyword == "Ks") {
      read_colour(at, material.specular);
    } else if (keyword == "Ke") {
      read_colour(at, material.emission);
    } else if (keyword == "Ns") {
      read_number(at, material.shininess);
    } else if (keyword == "Ni") {
      read_number(at, material.optical_density);
    } else if (keyword == "Pr") {
      stated_.roughness |= read_number(at, material.roughness);
    } else if (keyword == "Pm") {
      stated_.metallic |= read_number(at, material.metallic);
    } else if (keyword == "d") {
      material.is_halo = token_at(skip_blanks(at)) == "-halo";
      if (material.is_halo) at = skip_token(skip_blanks(at));
      stated_.opacity |= read_opacity(at, material.opacity);
    } else if (keyword == "Tr") {
      float transparency;
      // Where both stand, d is meant: writers disagree about the direction of Tr.
      if (read_opacity(at, transparency) && !stated_.opacity) material.opacity = 1 - transparency;
    } else if (keyword == "illum") {
      float model;
      if (read_number(at, model)) material.illumination = static_cast<int>(std::clamp(model, 0.0f, 10.0f));
    }
  }

  static TextureUse* texture_of(Material& material, std::string_view keyword) {
    if (keyword == "map_Kd") return &material.diffuse_map;
    if (keyword == "map_Ks") return &material.specular_map;
    if (keyword == "map_Ke") return &material.emission_map;
    if (keyword == "map_Ns") return &material.shininess_map;
    if (keyword == "map_d") return &material.opacity_map;
    if (keyword == "map_Pr") return &material.roughness_map;
    if (keyword == "map_Pm") return &material.metallic_map;
    if (keyword == "bump" || keyword == "map_bump" || keyword == "map_Bump") return &material.bump_map;
    if (keyword == "norm" || keyword == "map_Kn") return &material.normal_map;
    return nullptr;
  }

  void read_texture(const char* at, TextureUse& use) {
    MtlTexture texture = read_mtl_texture(at);
    if (texture.name.empty()) return warnings_.add(lines_.number(), "texture without a name");
    stated_.diffuse_map |= &use == &materials_.back().diffuse_map;
    texture.use.image = images_.add(folder_, texture.name, lines_.number(), warnings_);
    if (texture.use.is_used()) use = texture.use;
  }

  /// False, with a warning and `value` unchanged, if there is no number.
  bool read_number(const char* at, float& value) {
    at = skip_blanks(at);
    if (scan_float(at, value) != nullptr) return true;
    warnings_.add(lines_.number(), "not a number", token_at(at));
    return false;
  }

  bool read_opacity(const char* at, float& value) {
    if (opacity_line_ == 0) opacity_line_ = lines_.number();
    return read_number(at, value);
  }

  /// One number is a grey; "spectral" and "xyz" colours are not known.
  void read_colour(const char* at, Vector& colour) {
    Vector read;
    if (!read_number(at, read.x)) return;
    at = skip_blanks(skip_token(skip_blanks(at)));
    if (at_end(at)) {
      colour = Vector(read.x);
      return;
    }
    if (!read_number(at, read.y) || !read_number(skip_token(at), read.z)) return;
    colour = read;
  }

  ObjLines lines_;
  const std::filesystem::path& folder_;
  ImageTable& images_;
  ObjWarnings& warnings_;
  std::vector<Material>& materials_;
  std::size_t first_;              ///< material of this file
  Stated stated_;                  ///< of the last material
  std::int64_t opacity_line_ = 0;  ///< where d or Tr first stood
};

}  // namespace

void parse_mtl(std::string_view text, const std::filesystem::path& folder, ImageTable& images, ObjWarnings& warnings,
               std::vector<Material>& materials) {
  MtlReader(text, folder, images, warnings, materials).read();
}

}  // namespace facemap
