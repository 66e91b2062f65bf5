#include <facemap/error.h>
#include <facemap/generators.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>
#include <memory>

#include "commands.h"
#include "exit_codes.h"
#include "interrupt.h"
#include "output.h"
#include "text_values.h"
#include "usage_error.h"

namespace facemap::program {
namespace {

namespace fs = std::filesystem;

struct SceneArguments {
  std::string name;
  fs::path output;
  int detail = 1;
};

void write(std::ostream& out, const GeneratedScene& scene, const std::string& file_name,
           const std::string& shown_name) {
  errno = 0;
  try {
    write_obj(out, scene, file_name);
  } catch (const Error&) {
    throw Error(shown_name + ": cannot write" + (errno ? std::string(": ") + std::strerror(errno) : ""));
  }
}

/// A big scene takes seconds to write, so the file is made under another name, which a signal removes.
void write_beside_and_rename(const GeneratedScene& scene, const fs::path& output) {
  fs::path temporary = output;
  temporary += "." + std::to_string(::getpid()) + ".tmp";
  const RemovedOnSignal removed(temporary);
  try {
    std::ofstream out(temporary, std::ios::binary);
    write(out, scene, output.filename().string(), output.string());
    out.close();
    fs::rename(temporary, output);
  } catch (...) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw;
  }
}

void make_scene(const SceneArguments& arguments) {
  if (arguments.name.empty()) throw UsageError("no scene is named");
  check_output(arguments.output, {});
  const GeneratedScene scene = generate_scene(arguments.name, arguments.detail);
  if (is_standard_output(arguments.output)) {
    write(std::cout, scene, "model.obj", "standard output");
    return;
  }
  std::error_code ignored;
  if (fs::exists(arguments.output, ignored) && !fs::is_regular_file(arguments.output, ignored)) {
    std::ofstream out(arguments.output, std::ios::binary);
    write(out, scene, "model.obj", arguments.output.string());
  } else {
    write_beside_and_rename(scene, arguments.output);
  }
  std::cout << view_flags(scene) << std::endl;
}

std::string name_list() {
  std::string list;
  for (const std::string& name : generator_names()) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace

Command scene_command() {
  const auto arguments = std::make_shared<SceneArguments>();
  Command command;
  command.name = "scene";
  command.summary = "Make a scene with the number of faces of one of the paper's four";
  command.text =
      "Writes an OBJ file, and prints on standard output the flags (camera and eight lights) that show it as\n"
      "meant. They also stand in the file's first lines.\n";
  command.options = {
      {"SCENE", "", "", "one of " + name_list(),
       [arguments](const std::string& text) {
         arguments->name = generator_names()[parse_choice(text, generator_names())];
       },
       false, generator_names()},
      {"-o,--output", "FILE", "", "the OBJ file; - writes it to standard output",
       into(arguments->output, [](const std::string& text) { return fs::path(text); })},
      {"--detail", "N", "1",
       "refines every surface in proportion: the faces grow with its square; 1 to " + std::to_string(kMaxSceneDetail),
       into(arguments->detail, [](const std::string& text) { return parse_whole_number(text, 1, kMaxSceneDetail); })},
  };
  command.examples = {
      {"facemap scene chessboard -o chessboard.obj", "123,314 triangles"},
      {"facemap render chessboard.obj -o chessboard.png $(facemap scene chessboard -o chessboard.obj)",
       "make it, then draw it as meant"},
  };
  command.run = [arguments] {
    make_scene(*arguments);
    return kDone;
  };
  return command;
}

}  // namespace facemap::program
