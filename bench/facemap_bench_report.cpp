#include "facemap_bench_report.h"

#include <embree3/rtcore_config.h>
#include <facemap/instruction_set.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <initializer_list>
#include <sstream>
#include <utility>

namespace facemap::bench {
namespace {

using Part = double Phases::*;
constexpr std::pair<const char*, Part> kParts[] = {
    {"total", &Phases::total}, {"camera", &Phases::camera}, {"build", &Phases::build}, {"shade", &Phases::shade}};

Spread spread_of(const std::vector<Phases>& rounds, Part part) {
  std::vector<double> values;
  for (const Phases& phases : rounds) values.push_back(phases.*part);
  return bench::spread_of(std::move(values));
}

/// Nanoseconds a query of what follows the camera, and what they are of the limit.
double ns_a_query(const std::vector<Phases>& phases, const Rounds& rounds) {
  const double ms = spread_of(phases, &Phases::build).median + spread_of(phases, &Phases::shade).median;
  return rounds.queries ? ms * 1e6 / double(rounds.queries) : 0;
}

void print_rounds(const char* name, const Rounds& rounds) {
  for (const auto& [part_name, part] : kParts) {
    const Spread ours = spread_of(rounds.ours, part), theirs = spread_of(rounds.theirs, part);
    std::printf("  %-4s %-6s %9.2f (%8.2f ..%9.2f)  %9.2f (%8.2f ..%9.2f)  %7.2f\n", part == &Phases::total ? name : "",
                part_name, ours.median, ours.least, ours.most, theirs.median, theirs.least, theirs.most,
                ours.median > 0 ? theirs.median / ours.median : 0);
  }
}

void print_memory(const char* name, const Memory& memory) {
  std::printf("  memory at its peak, %s: %.2f MB, Embree %.2f MB: %.2f of it\n", name, double(memory.ours) * 1e-6,
              double(memory.theirs) * 1e-6, double(memory.ours) / double(memory.theirs));
}

void print_difference(const char* name, const Difference& d) {
  std::printf("  answers that differ, %s: %zu of %zu face ids, %zu of %zu light bits\n", name, d.ids, d.samples, d.bits,
              d.queries);
}

std::string quoted(const std::string& text) {
  std::string made = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') made += '\\';
    made += c;
  }
  return made + '"';
}

void write_rounds(std::ostream& out, const char* name, const Rounds& rounds) {
  out << ", \"" << name << "\": {\"speed\": " << rounds.speed();
  for (const auto& [side, phases] : {std::pair("facemap", &rounds.ours), std::pair("embree", &rounds.theirs)}) {
    out << ", \"" << side << "_ms\": {";
    for (const auto& [part_name, part] : kParts) {
      const Spread s = spread_of(*phases, part);
      out << (part == &Phases::total ? "" : ", ") << '"' << part_name << "\": [" << s.median << ", " << s.least << ", "
          << s.most << ']';
    }
    out << '}';
  }
  const Difference& d = rounds.difference;
  out << ", \"strategy\": " << quoted(rounds.statistics.strategy == Renderer::Strategy::Lists ? "lists" : "transposed")
      << ", \"reason\": " << quoted(rounds.statistics.reason) << ", \"queries\": " << rounds.queries
      << ", \"samples\": " << d.samples << ", \"ids_that_differ\": " << d.ids << ", \"bits\": " << d.queries
      << ", \"bits_that_differ\": " << d.bits << '}';
}

}  // namespace

std::string setting(const Options& options) {
  std::ostringstream out;
  std::ifstream file("/proc/cpuinfo");
  std::string line, processor = "unknown processor";
  while (std::getline(file, line)) {
    if (line.starts_with("model name")) processor = line.substr(line.find(": ") + 2);
  }
#ifdef __clang__
  const char* compiler = "clang++ " __clang_version__;
#else
  const char* compiler = "g++ " __VERSION__;
#endif
  out << processor << ", " << instruction_set() << ", " << compiler << ", Embree " << RTC_VERSION_STRING << ", "
      << options.threads << (options.threads == 1 ? " thread" : " threads")
      << (options.cpu_time ? ", processor time on a busy machine" : "");
  return out.str();
}

void print_case(const Case& question, const Measured& measured, const Options& options) {
  std::printf("%s: %zu faces, %d x %d pixels, %d samples each, %zu lights; Scene from mesh %.2f ms, before the clock\n",
              question.name.c_str(), question.scene.face_count(), options.size, options.size,
              options.samples * options.samples, question.lights.size(), question.scene_ms);
  std::printf("  opponent cold: %s; warm: %s; %d wide\n", measured.opponents.cold.name().c_str(),
              measured.opponents.warm.name().c_str(), measured.packet_width);
  std::printf("  FaceMap: cold %s; warm %s\n", measured.cold.statistics.reason.c_str(),
              measured.warm.statistics.reason.c_str());
  std::printf("  ms            FaceMap (   least ..     most)     Embree (   least ..     most)    speed\n");
  print_rounds("cold", measured.cold);
  print_rounds("warm", measured.warm);
  std::printf("  light maps made once, before the warm clock: %.0f ms\n", measured.keeping_ms);
  const double ours = ns_a_query(measured.warm.ours, measured.warm);
  const double theirs = ns_a_query(measured.warm.theirs, measured.warm), limit = measured.warm.limit_ns;
  std::printf("  warm, ns a query (%zu): FaceMap %.2f, Embree %.2f, limit %.2f; FaceMap over the limit %.2f\n",
              measured.warm.queries, ours, theirs, limit, limit > 0 ? ours / limit : 0);
  print_memory("cold", measured.cold_memory);
  print_memory("warm", measured.warm_memory);
  const auto faces = double(question.scene.face_count());
  std::printf("  bytes a face: FaceMap's maps and working memory %.1f, Embree's hierarchy %.1f\n",
              double(measured.our_bytes) / faces, double(measured.their_bytes) / faces);
  print_difference("cold", measured.cold.difference);
  print_difference("warm", measured.warm.difference);
  if (options.confirm) {
    std::printf("  asked again of the lists: %zu samples, FaceMap right in %zu\n", measured.asked_again,
                measured.confirmed);
  }
  std::fflush(stdout);
}

void print_summary(const std::vector<Speeds>& speeds) {
  double cold = 0, warm = 0;
  std::printf("\nspeed: Embree's time over FaceMap's\n%-24s %6s %6s\n", "", "cold", "warm");
  for (const Speeds& s : speeds) {
    std::printf("%-24s %6.2f %6.2f\n", s.name.c_str(), s.cold, s.warm);
    cold += std::log(s.cold);
    warm += std::log(s.warm);
  }
  const auto count = double(speeds.size());
  std::printf("%-24s %6.2f %6.2f\n", "geometric mean", std::exp(cold / count), std::exp(warm / count));
}

std::string json_line(const Case& question, const Measured& measured, const Options& options) {
  std::ostringstream out;
  out.precision(6);
  out << "{\"scene\": " << quoted(question.name) << ", \"setting\": " << quoted(setting(options))
      << ", \"target\": " << quoted(instruction_set()) << ", \"faces\": " << question.scene.face_count()
      << ", \"size\": " << options.size << ", \"samples\": " << options.samples
      << ", \"lights\": " << question.lights.size() << ", \"threads\": " << options.threads
      << ", \"repeat\": " << options.repeat << ", \"scene_ms\": " << question.scene_ms
      << ", \"packet_width\": " << measured.packet_width
      << ", \"opponent_cold\": " << quoted(measured.opponents.cold.name())
      << ", \"opponent_warm\": " << quoted(measured.opponents.warm.name());
  write_rounds(out, "cold", measured.cold);
  write_rounds(out, "warm", measured.warm);
  const double ours = ns_a_query(measured.warm.ours, measured.warm);
  out << ", \"warm_ns_a_query\": {\"facemap\": " << ours
      << ", \"embree\": " << ns_a_query(measured.warm.theirs, measured.warm)
      << ", \"limit\": " << measured.warm.limit_ns << '}';
  for (const auto& [name, memory] :
       {std::pair("cold_memory", measured.cold_memory), std::pair("warm_memory", measured.warm_memory)}) {
    out << ", \"" << name << "\": {\"facemap\": " << memory.ours << ", \"embree\": " << memory.theirs << '}';
  }
  out << ", \"kept_bytes\": {\"facemap\": " << measured.our_bytes << ", \"embree\": " << measured.their_bytes << '}';
  if (options.confirm) {
    out << ", \"asked_again\": " << measured.asked_again << ", \"confirmed\": " << measured.confirmed;
  }
  out << "}\n";
  return out.str();
}

}  // namespace facemap::bench
