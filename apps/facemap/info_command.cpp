#include <iomanip>
#include <iostream>
#include <memory>

#include "commands.h"
#include "exit_codes.h"
#include "model.h"
#include "text_values.h"

namespace facemap::program {
namespace {

struct InfoArguments {
  std::filesystem::path model;
  bool names = false;
};

template <typename Value>
void row(const char* name, const Value& value, const char* what = "") {
  std::cout << "  " << std::left << std::setw(22) << name << value << what << '\n';
}

void print_oddities(const Scene& scene) {
  const OddFaces& odd = scene.odd_faces();
  const OBJ::Report& report = scene.report();
  if (odd.zero_area) row("left out", odd.zero_area, " faces of zero area");
  if (odd.repeated_vertex) row("left out", odd.repeated_vertex, " faces that name a vertex twice");
  if (odd.duplicate) row("left out", odd.duplicate, " faces that repeat another's positions");
  if (report.self_intersecting_polygons)
    row("fans", report.self_intersecting_polygons, " polygons that cross themselves");
  for (const OBJ::Ignored& ignored : report.ignored) {
    row("ignored", ignored.statement + ", " + std::to_string(ignored.count) + " times, first in line " +
                       std::to_string(ignored.first_line));
  }
  for (const std::string& warning : report.warnings) row("warning", warning);
}

/// A name on one line: control bytes as '?'.
std::string printable(std::string name) {
  for (char& c : name) c = static_cast<unsigned char>(c) < ' ' || c == 127 ? '?' : c;
  return name;
}

/// With the numbers that the planes `object` and `material` have.
void print_names(const Scene& scene) {
  for (std::size_t i = 0; i < scene.objects().size(); ++i) {
    row(("object " + std::to_string(i)).c_str(), printable(scene.objects()[i]));
  }
  for (std::size_t i = 0; i < scene.materials().size(); ++i) {
    row(("material " + std::to_string(i)).c_str(), printable(scene.materials()[i].name));
  }
}

void print_info(const InfoArguments& arguments) {
  const Scene scene = load_model(arguments.model, true);
  const OBJ::Report& report = scene.report();
  std::cout << arguments.model.string() << '\n';
  row("vertices", report.vertices);
  row("normals", report.normals);
  row("texture coordinates", report.texture_coordinates);
  row("polygons", report.polygons);
  row("triangles", scene.face_count());
  row("kept", scene.kept_faces().size(), " triangles that take part in pictures");
  row("objects", report.objects);
  row("groups", report.groups);
  row("materials", scene.materials().size());
  row("box from", text_of(scene.lower()));
  row("box to", text_of(scene.upper()));
  row("centre", text_of(Vector(scene.centre())));
  row("radius", text_of(static_cast<float>(scene.bounding_radius())));
  print_oddities(scene);
  if (arguments.names) print_names(scene);
  std::cout << std::flush;
}

}  // namespace

Command info_command() {
  const auto arguments = std::make_shared<InfoArguments>();
  Command command;
  command.name = "info";
  command.summary = "Say what is in a model, and what is odd in it";
  command.text =
      "Counts, bounds, faces that are left out of pictures and why, statements that were read over, warnings.\n"
      "Faces left out keep their numbers: nothing is renumbered.\n";
  command.options = {{"MODEL", "", "", "the model: an OBJ, glTF, PLY or STL file; - reads it from standard input",
                      into(arguments->model, [](const std::string& text) { return std::filesystem::path(text); })},
                     {"--names", "", "", "lists objects and materials with their numbers in planes of ids",
                      [arguments](const std::string&) { arguments->names = true; }}};
  command.examples = {{"facemap info model.obj", "what is in this file?"},
                      {"facemap info model.glb --names", "which object is number 3 of --aov object?"}};
  command.run = [arguments] {
    print_info(*arguments);
    return kDone;
  };
  return command;
}

}  // namespace facemap::program
