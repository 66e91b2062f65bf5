#include "stats.h"

#include <sys/resource.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <utility>
#include <vector>

#include "report.h"

namespace facemap::program {
namespace {

std::string number(std::uint64_t value) { return std::to_string(value); }

std::string milliseconds(double value) {
  char buffer[64];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, 3);
  return std::string(buffer, error == std::errc() ? end : buffer);
}

std::uint64_t peak_memory_bytes() {
  struct rusage usage {};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

/// A name and its value, a number or text, or the values below it.
struct Field {
  std::string name, value;
  std::vector<Field> parts = {};
};

Field text_field(std::string name, const std::string& text) { return {std::move(name), json_text(text)}; }

Field tests(std::string name, std::uint64_t queries, const Counters& counters) {
  return {std::move(name),
          "",
          {{"queries", number(queries)},
           {"by_float", number(counters.by_float)},
           {"by_double", number(counters.by_double)},
           {"by_exact", number(counters.by_exact)}}};
}

const char* name_of(Renderer::Strategy strategy) {
  switch (strategy) {
    case Renderer::Strategy::Lists:
      return "lists";
    case Renderer::Strategy::Transposed:
      return "transposed";
    case Renderer::Strategy::Auto:
      break;
  }
  return "auto";
}

std::vector<Field> fields_of(const Stats& stats, const Scene& scene) {
  const Renderer::Statistics& frames = stats.frames;
  return {
      text_field("version", FACEMAP_VERSION),
      text_field("model", stats.model),
      {"vertices", number(scene.mesh().positions.size())},
      {"faces", number(scene.face_count())},
      {"kept_faces", number(scene.kept_faces().size())},
      {"lights", number(stats.light_count)},
      {"frames", number(stats.frame_count)},
      {"width", std::to_string(stats.width)},
      {"height", std::to_string(stats.height)},
      {"threads", std::to_string(frames.threads)},
      text_field("target", frames.target),
      text_field("strategy", name_of(frames.strategy)),
      text_field("reason", frames.reason),
      {"upsampled_pixels", number(frames.upsampled_pixels)},
      {"milliseconds",
       "",
       {{"load", milliseconds(stats.load_ms)},
        {"camera_map", milliseconds(frames.camera_map_ms)},
        {"light_maps", milliseconds(frames.light_maps_ms)},
        {"shade", milliseconds(frames.shade_ms)},
        {"write", milliseconds(stats.write_ms)},
        {"wait_for_write", milliseconds(stats.wait_ms)},
        {"total", milliseconds(stats.total_ms)}}},
      {"peak_memory_bytes", number(peak_memory_bytes())},
      {"map_bytes", number(frames.map_bytes)},
      tests("camera_tests", frames.camera_queries, frames.camera_tests),
      tests("light_tests", frames.light_queries, frames.light_tests),
  };
}

std::string json(const Field& field) {
  if (field.parts.empty()) return json_text(field.name) + ": " + field.value;
  std::string parts;
  for (const Field& part : field.parts) parts += (parts.empty() ? "" : ", ") + json(part);
  return json_text(field.name) + ": {" + parts + "}";
}

std::string text_line(const std::string& name, const std::string& value) {
  constexpr std::size_t kValueColumn = 26;
  const bool is_text = value.starts_with('"');
  std::string line = name + std::string(kValueColumn - std::min(kValueColumn - 1, name.size()), ' ');
  return line + (is_text ? value.substr(1, value.size() - 2) : value) + "\n";
}

}  // namespace

void Stats::add_frame(const Renderer::Statistics& frame) {
  Renderer::Statistics sum = frame;
  sum.camera_map_ms += frames.camera_map_ms;
  sum.light_maps_ms += frames.light_maps_ms;
  sum.shade_ms += frames.shade_ms;
  sum.camera_queries += frames.camera_queries;
  sum.light_queries += frames.light_queries;
  sum.upsampled_pixels += frames.upsampled_pixels;
  sum.camera_tests += frames.camera_tests;
  sum.light_tests += frames.light_tests;
  sum.map_bytes = std::max(sum.map_bytes, frames.map_bytes);
  frames = std::move(sum);
  ++frame_count;
}

std::string stats_json(const Stats& stats, const Scene& scene) {
  std::string text;
  for (const Field& field : fields_of(stats, scene)) text += (text.empty() ? "{\n  " : ",\n  ") + json(field);
  return text + "\n}\n";
}

std::string stats_text(const Stats& stats, const Scene& scene) {
  std::string text;
  for (const Field& field : fields_of(stats, scene)) {
    if (field.parts.empty()) text += text_line(field.name, field.value);
    for (const Field& part : field.parts) text += text_line(field.name + "." + part.name, part.value);
  }
  return text;
}

}  // namespace facemap::program
