#include "scene/mtl_texture.h"

#include <algorithm>
#include <iterator>

#include "scene/number.h"
#include "scene/obj_lines.h"

namespace facemap {
namespace {

std::string_view token_at(const char* at) { return {at, static_cast<std::size_t>(skip_token(at) - at)}; }

/// What follows an option: so many words, then at most so many numbers.
struct Option {
  std::string_view name;
  int words;
  int numbers;
};
constexpr Option kOptions[] = {
    {"-blendu", 1, 0}, {"-blendv", 1, 0}, {"-cc", 1, 0},    {"-clamp", 1, 0},      {"-imfchan", 1, 0},
    {"-type", 1, 0},   {"-bm", 0, 1},     {"-boost", 0, 1}, {"-texres", 0, 1},     {"-mm", 0, 2},
    {"-o", 0, 3},      {"-s", 0, 3},      {"-t", 0, 3},     {"-colorspace", 1, 0},
};

/// r, g, b, m (matte: alpha); l and z (luminance, depth) are the usual one.
int channel_of(std::string_view word) {
  constexpr std::string_view kChannels = "rgbm";
  const std::size_t found = word.size() == 1 ? kChannels.find(word) : std::string_view::npos;
  return found == std::string_view::npos ? -1 : static_cast<int>(found);
}

void apply(const Option& option, std::string_view word, const float* numbers, int count, TextureUse& use) {
  if (option.name == "-clamp" && word == "on") use.wrap_u = use.wrap_v = TextureUse::Wrap::Clamp;
  if (option.name == "-imfchan") use.channel = channel_of(word);
  if (count == 0) return;
  if (option.name == "-bm") use.strength = numbers[0];
  if (option.name == "-o") use.offset = {numbers[0], count > 1 ? numbers[1] : 0};
  if (option.name == "-s") use.scale = {numbers[0], count > 1 ? numbers[1] : 1};
  if (option.name == "-mm" && count == 2) {
    use.base = numbers[0];
    use.gain = numbers[1];
  }
}

/// Reads the option at `at` and returns what comes next; null if none that is known stands there.
const char* read_option(const char* at, TextureUse& use) {
  const auto* const option = std::find_if(std::begin(kOptions), std::end(kOptions),
                                          [&](const Option& known) { return known.name == token_at(at); });
  if (option == std::end(kOptions)) return nullptr;
  at = skip_blanks(skip_token(at));
  const std::string_view word = option->words > 0 ? token_at(at) : std::string_view();
  for (int i = 0; i < option->words; ++i) at = skip_blanks(skip_token(at));
  float numbers[3];
  int count = 0;
  for (; count < option->numbers; ++count) {
    const char* const end = scan_float(at, numbers[count]);
    if (end == nullptr) break;
    at = skip_blanks(end);
  }
  apply(*option, word, numbers, count, use);
  return at;
}

/// Where the options begin that end the line, which are read; null if there are none.
const char* read_last_options(const char* name, TextureUse& use) {
  const char* at = skip_blanks(skip_token(name));
  while (*at != '\n') {
    const char* const first = at;
    TextureUse with = use;
    for (const char* next = at; next != nullptr && *next == '-';) {
      next = read_option(next, with);
      if (next != nullptr) at = next;
    }
    if (at != first && *at == '\n') {
      use = with;
      return first;
    }
    at = skip_blanks(skip_token(at));
  }
  return nullptr;
}

}  // namespace

MtlTexture read_mtl_texture(const char* at) {
  MtlTexture texture;
  at = skip_blanks(at);
  while (*at == '-') {
    const char* const next = read_option(at, texture.use);
    if (next == nullptr) break;  // a name may begin with a dash
    at = next;
  }
  texture.name = rest_of_line(at);
  const char* const end = texture.name.empty() ? nullptr : read_last_options(at, texture.use);
  if (end == nullptr) return texture;
  texture.name = texture.name.substr(0, static_cast<std::size_t>(end - texture.name.data()));
  while (!texture.name.empty() && is_blank(texture.name.back())) texture.name.remove_suffix(1);
  return texture;
}

}  // namespace facemap
