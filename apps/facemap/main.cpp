#include <facemap/error.h>
#include <facemap/instruction_set.h>

#include <algorithm>
#include <exception>
#include <iostream>
#include <new>
#include <string>

#include "commands.h"
#include "exit_codes.h"
#include "interrupt.h"
#include "report.h"
#include "usage_error.h"

namespace facemap::program {

std::vector<Command> all_commands() {
  return {render_command(), info_command(), map_command(), compare_command(), sheet_command(), scene_command()};
}

namespace {

int complain(const char* reason, int exit_code) {
  say_error(reason);
  return exit_code;
}

/// What the environment asks for is part of the command line.
void check_environment() {
  try {
    instruction_set();
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
}

int run(int argc, const char* const* argv) {
  const std::vector<Command> commands = all_commands();
  std::string answer;
  const Command* command = parse_command_line(commands, argc, argv, answer);
  int exit_code = kDone;
  if (command) {
    check_environment();
    exit_code = command->run();
  } else {
    std::cout << answer;
  }
  std::cout.flush();
  return std::cout ? exit_code : complain("standard output: cannot write", kFailed);
}

}  // namespace
}  // namespace facemap::program

int main(int argc, char** argv) {
  using namespace facemap::program;
  // Errors of the command line itself are told as it asks, too.
  const bool is_json =
      std::any_of(argv + 1, argv + argc, [](const char* word) { return std::string(word) == "--log-json"; });
  set_report_style({false, false, is_json});
  try {
    catch_signals();
    return run(argc, argv);
  } catch (const UsageError& error) {
    return complain(error.what(), kWrongUsage);
  } catch (const std::bad_alloc&) {
    return complain("not enough memory", kFailed);
  } catch (const std::exception& error) {
    return complain(error.what(), kFailed);
  }
}
