#include "output_flags.h"

#include <algorithm>
#include <set>
#include <string>

#include "output.h"
#include "text_values.h"
#include "usage_error.h"

namespace facemap::program {
namespace {

namespace fs = std::filesystem;

constexpr int kBits[] = {8, 16, 32};  ///< of a channel

std::vector<std::string> plane_names() {
  std::vector<std::string> names;
  for (const Plane plane : all_planes()) names.emplace_back(name_of(plane));
  return names;
}

bool has_file(const FrameFiles& files, Plane plane) {
  return std::any_of(files.planes.begin(), files.planes.end(), [&](const PlaneFile& f) { return f.plane == plane; });
}

/// NAME=FILE, or NAME alone: a layer of the picture.
void add_plane(WantedOutput& output, const std::string& text) {
  const std::size_t equals = std::min(text.find('='), text.size());
  const std::string name = text.substr(0, equals);
  const Plane plane = all_planes()[static_cast<std::size_t>(parse_choice(name, plane_names()))];
  if (equals + 1 == text.size()) throw UsageError("'" + text + "' names no file");
  if (equals == text.size() ? output.layers.has(plane) : has_file(output.files, plane)) {
    throw UsageError(name + " is given more than once");
  }
  if (equals == text.size()) return output.layers.add(plane);
  output.files.planes.push_back({plane, text.substr(equals + 1)});
}

/// What the flags say of the files must make sense.
void check_formats(const WantedOutput& output) {
  const fs::path& picture = output.files.picture;
  const FileFormat format = picture_format(picture, output.format);
  for (const PlaneFile& plane : output.files.planes) {
    if (is_standard_output(plane.file)) throw UsageError("--aov: standard output takes the picture alone");
    plane_format(plane.file, plane.plane);
  }
  for (const Plane plane : all_planes()) {
    if (!output.layers.has(plane) || format == FileFormat::Exr) continue;
    const std::string name = name_of(plane);
    throw UsageError("--aov " + name + ": only an EXR picture has layers; give it a file: " + name + "=FILE");
  }
}

/// The scene is written last, when the picture is there.
void check_scene_file(const fs::path& scene, const fs::path& picture, const fs::path& model) {
  if (is_standard_output(scene) && is_standard_output(picture))
    throw UsageError("--save-scene: standard output takes the picture alone");
  check_output(scene, model);
}

/// Files by the names that the file system has for them.
class KnownFiles {
 public:
  void add(const fs::path& file) {
    if (is_standard_output(file)) return;
    if (!names_.insert(settled_name(file)).second) throw UsageError(file.string() + ": two outputs name this file");
  }

 private:
  std::set<fs::path> names_;
};

}  // namespace

PlaneSet WantedOutput::planes() const {
  PlaneSet planes = layers;
  for (const PlaneFile& plane : files.planes) planes.add(plane.plane);
  return planes;
}

std::vector<Option> output_options(WantedOutput& a, std::optional<FrameRange>& range) {
  return {
      {"--format", "FORMAT", "by name",
       "the picture's format, whatever its file is called; of -o - it is png if not said",
       [&a](const std::string& text) { a.format.format = static_cast<FileFormat>(parse_choice(text, format_names())); },
       false, format_names()},
      {"--bits",
       "N",
       "",
       "bits of a colour: PNG 8 (if not said) or 16, EXR 16 (half, if not said) or 32 (float)",
       into(a.format.bits,
            [](const std::string& text) {
              return kBits[parse_choice(text, {"8", "16", "32"})];
            }),
       false,
       {"8", "16", "32"}},
      {"--quality", "N", "90", "of JPEG, 1 to 100",
       into(a.format.quality, [](const std::string& text) { return parse_whole_number(text, 1, 100); })},
      {"--aov", "NAME[=FILE]", "",
       "writes a plane: depth (along the ray), z (along the sight), position, normal, face-normal, albedo, uv, id, "
       "object, material, lights (one bit a light, 1 is lit) or shadows (how many lights are hidden); to a .npy, .exr, "
       ".pfm, or, for the eye, .png or .jpg; without a file it is a layer of an EXR picture; once a plane; {n} and "
       "{model} as in -o",
       [&a](const std::string& text) { add_plane(a, text); }, true},
      {"--frames", "A..B", "all", "of several pictures only these: numbers from 0, both ends count; 7 or 0-9 will do",
       into(range, parse_frame_range)},
  };
}

std::vector<FrameFiles> check_output_files(const WantedOutput& output, const fs::path& model, const FrameRange& range,
                                           std::size_t all) {
  if (output.files.picture.empty()) check_picture_output(output.files.picture, model);
  const auto names = [&](const fs::path& pattern) { return frame_files(pattern, model, all, range); };
  std::vector<FrameFiles> frames;
  KnownFiles known;
  for (const fs::path& picture : names(output.files.picture)) {
    frames.push_back({picture, {}});
    check_picture_output(picture, model);
    known.add(picture);
  }
  for (const auto& [plane, pattern] : output.files.planes) {
    const std::vector<fs::path> files = names(pattern);
    for (std::size_t i = 0; i < files.size(); ++i) {
      check_output(files[i], model);
      known.add(files[i]);
      frames[i].planes.push_back({plane, files[i]});
    }
  }
  if (!output.scene.empty()) {
    check_scene_file(output.scene, output.files.picture, model);
    known.add(output.scene);
  }
  check_formats(output);
  return frames;
}

}  // namespace facemap::program
