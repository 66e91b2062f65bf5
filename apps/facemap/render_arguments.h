#pragma once

#include <facemap/model.h>
#include <facemap/renderer.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "frames.h"
#include "options.h"
#include "output_flags.h"
#include "picture_part.h"
#include "text_values.h"
#include "words.h"

namespace facemap::program {

enum class StatsFormat { None, Json, Text };

struct WantedGround {
  bool is_none = false;
  std::optional<Color> color;  ///< none: the usual one
};

/// Of files that may come from anywhere: what an ordinary machine takes.
inline ModelLimits usual_limits() {
  ModelLimits limits;
  limits.max_bytes = std::uint64_t{1} << 34;
  limits.max_faces = 100'000'000;
  return limits;
}

/// What facemap render is told.
struct RenderArguments {
  std::filesystem::path model;
  WantedOutput output;
  std::optional<Size> wanted_size;
  WantedPart part;
  WantedFrames frames;
  std::vector<Light> lights;
  float intensity = 1;
  Samples samples;
  Renderer::Options options;
  ModelLimits limits = usual_limits();
  long long max_pixels = kMaxPixels;
  double scale = 1;  ///< of all models
  std::optional<WantedGround> ground;
  bool studio = false;
  std::string camera_name;  ///< of the file's cameras: a name, a number from 0, or "all"; empty: the first
  bool file_camera = true, file_lights = true;
  StatsFormat stats = StatsFormat::None;
  bool quiet = false, verbose = false, log_json = false;

  Size size() const { return wanted_size.value_or(made_up_size(frames.lens)); }
};

/// The rows of the table; they set `arguments`, which must outlive them.
std::vector<Option> render_options(RenderArguments& arguments);

/// Those of its rows that say how a camera sees.
std::vector<Option> view_options(RenderArguments& arguments);

/// Those about the models and what surrounds them; those of limits for files that are not to be trusted.
std::vector<Option> scene_options(RenderArguments& arguments);
std::vector<Option> limit_options(RenderArguments& arguments);

/// What the words say. Throws as set_options.
RenderArguments arguments_of(const Words& words);

/// Throws UsageError if they ask for more than the limits allow, or contradict each other.
void check_limits(const RenderArguments& arguments);

/// The files of each frame, known to be writable and to be different ones. Throws UsageError or Error.
std::vector<FrameFiles> check_files(const RenderArguments& arguments, std::size_t frame_count);

/// With size, samples and planes.
Renderer::Options renderer_options(const RenderArguments& arguments);

}  // namespace facemap::program
