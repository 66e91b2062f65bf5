#include "scene/mtl.h"

#include <algorithm>
#include <array>

#include "scene/number.h"
#include "scene/obj_lines.h"

namespace facemap {

namespace {

bool at_end(const char* at) { return *at == '\n' || *at == '#'; }

std::string_view token_at(const char* at) { return {at, static_cast<std::size_t>(skip_token(at) - at)}; }

/// Number of numbers at most, and whether a word follows them, for each option of a texture statement.
struct TextureOption {
  std::string_view name;
  int words;
  int numbers;
};
constexpr TextureOption kTextureOptions[] = {
    {"-blendu", 1, 0}, {"-blendv", 1, 0}, {"-cc", 1, 0},    {"-clamp", 1, 0},      {"-imfchan", 1, 0},
    {"-type", 1, 0},   {"-bm", 0, 1},     {"-boost", 0, 1}, {"-texres", 0, 1},     {"-mm", 0, 2},
    {"-o", 0, 3},      {"-s", 0, 3},      {"-t", 0, 3},     {"-colorspace", 1, 0},
};

/// Skips the options before a texture's file name. An option that is not known is taken for the name.
const char* skip_texture_options(const char* at) {
  at = skip_blanks(at);
  while (*at == '-') {
    const auto* const option = std::find_if(std::begin(kTextureOptions), std::end(kTextureOptions),
                                            [&](const TextureOption& known) { return known.name == token_at(at); });
    if (option == std::end(kTextureOptions)) break;
    at = skip_blanks(skip_token(at));
    for (int i = 0; i < option->words; ++i) at = skip_blanks(skip_token(at));
    float ignored;
    for (int i = 0; i < option->numbers; ++i) {
      const char* const end = scan_float(at, ignored);
      if (end == nullptr) break;
      at = skip_blanks(end);
    }
  }
  return at;
}

/// Reads the statements of one MTL file.
class MtlReader {
 public:
  MtlReader(std::string_view text, ObjWarnings& warnings, std::vector<Material>& materials)
      : lines_(text), warnings_(warnings), materials_(materials) {}

  void read() {
    while (lines_.next()) {
      const char* const at = skip_blanks(lines_.begin());
      if (!at_end(at)) read_statement(token_at(at), skip_token(at));
    }
  }

 private:
  void read_statement(std::string_view keyword, const char* at) {
    if (keyword == "newmtl") {
      materials_.emplace_back().name = rest_of_line(at);
      has_material_ = true;
      has_opacity_ = false;
    } else if (!has_material_) {
      warnings_.add(lines_.number(), "statement before the first newmtl", keyword);
    } else {
      read_property(materials_.back(), keyword, at);
    }
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
    } else if (keyword == "d") {
      if (token_at(skip_blanks(at)) == "-halo") at = skip_token(skip_blanks(at));
      has_opacity_ |= read_number(at, material.opacity);
    } else if (keyword == "Tr") {
      float transparency;
      // Where both stand, d is meant: writers disagree about the direction of Tr.
      if (read_number(at, transparency) && !has_opacity_) material.opacity = 1 - transparency;
    } else if (keyword == "illum") {
      float model;
      if (read_number(at, model)) material.illumination = static_cast<int>(std::clamp(model, 0.0f, 10.0f));
    } else if (is_texture(keyword)) {
      material.textures[std::string(keyword)] = rest_of_line(skip_texture_options(at));
    }
  }

  static bool is_texture(std::string_view keyword) {
    constexpr std::string_view kOthers[] = {"bump", "disp", "decal", "refl", "norm"};
    return keyword.starts_with("map_") ||
           std::find(std::begin(kOthers), std::end(kOthers), keyword) != std::end(kOthers);
  }

  /// False, with a warning and `value` unchanged, if there is no number.
  bool read_number(const char* at, float& value) {
    at = skip_blanks(at);
    if (scan_float(at, value) != nullptr) return true;
    warnings_.add(lines_.number(), "not a number", token_at(at));
    return false;
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
  ObjWarnings& warnings_;
  std::vector<Material>& materials_;
  bool has_material_ = false;  ///< of this file
  bool has_opacity_ = false;   ///< of this material: d was read
};

}  // namespace

void parse_mtl(std::string_view text, ObjWarnings& warnings, std::vector<Material>& materials) {
  MtlReader(text, warnings, materials).read();
}

}  // namespace facemap
