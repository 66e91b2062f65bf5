#pragma once

#include <facemap/renderer.h>

#include <filesystem>
#include <optional>
#include <vector>

#include "frames.h"
#include "options.h"
#include "output_flags.h"
#include "picture_part.h"
#include "text_values.h"

namespace facemap::program {

enum class StatsFormat { None, Json, Text };

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
  StatsFormat stats = StatsFormat::None;
  bool quiet = false;

  Size size() const { return wanted_size.value_or(made_up_size(frames.lens)); }
};

/// The rows of the table; they set `arguments`, which must outlive them.
std::vector<Option> render_options(RenderArguments& arguments);

/// The files of each frame, known to be writable and to be different ones. Throws UsageError or Error.
std::vector<FrameFiles> check_files(const RenderArguments& arguments);

/// With size, samples and planes.
Renderer::Options renderer_options(const RenderArguments& arguments);

}  // namespace facemap::program
