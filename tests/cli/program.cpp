#include "cli/program.h"

#include <stdlib.h>
#include <sys/wait.h>

#include <fstream>
#include <iterator>
#include <set>

namespace fs = std::filesystem;

namespace {

constexpr const char* kCube =
    "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 4 1 5 8\n";

fs::path new_folder() {
  std::string name = (fs::temp_directory_path() / "facemap-cli-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  return name;
}

}  // namespace

std::string text_of_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

Program::Program() : folder_(new_folder()), captured_(new_folder()) { write_file("cube.obj", kCube); }

Program::~Program() {
  fs::remove_all(folder_);
  fs::remove_all(captured_);
}

Outcome Program::run(const std::string& arguments) const { return run_shell("\"$facemap\" " + arguments); }

Outcome Program::run_shell(const std::string& command) const {
  const std::string script = "facemap='" FACEMAP_PROGRAM "'; cd '" + folder_.string() + "' && { " + command + "\n} >'" +
                             (captured_ / "out").string() + "' 2>'" + (captured_ / "err").string() + "'";
  const int status = std::system(script.c_str());
  Outcome outcome;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.out = text_of_file(captured_ / "out");
  outcome.err = text_of_file(captured_ / "err");
  return outcome;
}

void Program::write_file(const std::string& name, const std::string& text) const {
  std::ofstream(folder_ / name, std::ios::binary) << text;
}

std::string Program::files() const {
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) names.insert(entry.path().filename());
  names.erase("cube.obj");
  std::string list;
  for (const std::string& name : names) list += name + " ";
  return list;
}

void expect_error(const Outcome& outcome, int exit_code, const std::string& message) {
  EXPECT_EQ(outcome.exit_code, exit_code);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err.substr(0, outcome.err.find('\n')), "facemap: " + message);
}
