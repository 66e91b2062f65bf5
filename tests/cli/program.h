#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

/// What came of running the program.
struct Outcome {
  int exit_code = 0;  ///< 128 + signal if a signal ended it, as shells say it
  std::string out, err;
};

std::string text_of_file(const std::filesystem::path& path);

/// A test in an empty folder of its own, where the program runs; removed afterwards. cube.obj is there.
class Program : public testing::Test {
 protected:
  Program();
  ~Program() override;

  /// Runs "facemap ARGUMENTS" through the shell: quotes, redirections and pipes work.
  Outcome run(const std::string& arguments) const;

  /// Runs a shell command in the folder; "$facemap" is the program.
  Outcome run_shell(const std::string& command) const;

  void write_file(const std::string& name, const std::string& text) const;
  std::string read_file(const std::string& name) const { return text_of_file(folder_ / name); }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }

  /// Names in the folder, sorted, each followed by a blank; what the test class itself puts there left out.
  std::string files() const;

  std::filesystem::path folder_;

 private:
  std::filesystem::path captured_;  ///< folder for standard output and error
};

/// Fails unless the program ended with `exit_code` and printed nothing but "facemap: " `message` as its first line.
void expect_error(const Outcome& outcome, int exit_code, const std::string& message);
