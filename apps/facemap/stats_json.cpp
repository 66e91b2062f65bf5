#include "stats_json.h"

#include <sys/resource.h>

#include <charconv>
#include <cstdint>
#include <utility>

namespace facemap::program {
namespace {

std::string quoted(const std::string& text) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (code < 0x20) {
      result += std::string("\\u00") + kDigits[code >> 4] + kDigits[code & 15];
    } else {
      result += c;
    }
  }
  return result + "\"";
}

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

std::string tests(std::uint64_t queries, const Counters& counters) {
  return "{\"queries\": " + number(queries) + ", \"by_float\": " + number(counters.by_float) +
         ", \"by_double\": " + number(counters.by_double) + ", \"by_exact\": " + number(counters.by_exact) + "}";
}

}  // namespace

std::string stats_json(const RunFacts& facts, const Scene& scene, const Renderer::Statistics& statistics) {
  const std::string phases =
      "{\"load\": " + milliseconds(facts.load_ms) + ", \"camera_map\": " + milliseconds(statistics.camera_map_ms) +
      ", \"light_maps\": " + milliseconds(statistics.light_maps_ms) +
      ", \"shade\": " + milliseconds(statistics.shade_ms) + ", \"write\": " + milliseconds(facts.write_ms) +
      ", \"total\": " + milliseconds(facts.total_ms) + "}";
  const std::pair<const char*, std::string> fields[] = {
      {"version", quoted(FACEMAP_VERSION)},
      {"model", quoted(facts.model)},
      {"vertices", number(scene.mesh().positions.size())},
      {"faces", number(scene.face_count())},
      {"kept_faces", number(scene.kept_faces().size())},
      {"lights", number(facts.light_count)},
      {"width", std::to_string(facts.width)},
      {"height", std::to_string(facts.height)},
      {"upsampled_pixels", number(statistics.upsampled_pixels)},
      {"milliseconds", phases},
      {"peak_memory_bytes", number(peak_memory_bytes())},
      {"map_bytes", number(statistics.map_bytes)},
      {"camera_tests", tests(statistics.camera_queries, statistics.camera_tests)},
      {"light_tests", tests(statistics.light_queries, statistics.light_tests)},
  };
  std::string json;
  for (const auto& [name, value] : fields) json += (json.empty() ? "{\n  " : ",\n  ") + quoted(name) + ": " + value;
  return json + "\n}\n";
}

}  // namespace facemap::program
