// Whatever ends a run, no half-written file is left under the name that was asked for.

#include <sys/mount.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

#include "cli/program.h"
#include "support/random.h"

namespace {

namespace fs = std::filesystem;

constexpr const char* kOld = "what stood there before";
constexpr const char* kView = " --camera 3,2,5 --look-at 0,0,0 --light 4,6,3 -q ";

/// Names that together need every writer: the picture's, and planes'.
struct Outputs {
  const char* flags;
  std::vector<std::string> names;
};

/// Leaves a page of the disk.
constexpr const char* kFill = "cat /dev/zero >disk/rest 2>/dev/null; truncate -s -4096 disk/rest";

const Outputs kOutputs[] = {
    {"-o a.png", {"a.png"}},
    {"-o a.png --bits 16", {"a.png"}},
    {"-o a.jpg --quality 100", {"a.jpg"}},
    {"-o a.exr --bits 32 --aov position --aov id", {"a.exr"}},
    {"-o a.pfm", {"a.pfm"}},
    {"-o a.npy", {"a.npy"}},
    {"-o a.png --aov z=z.pfm --aov id=i.npy --aov uv=u.exr --aov normal=n.png",
     {"a.png", "i.npy", "n.png", "u.exr", "z.pfm"}},
};

struct Signal {
  const char* name;
  int number;
};
constexpr Signal kSignals[] = {{"INT", SIGINT}, {"TERM", SIGTERM}, {"HUP", SIGHUP}, {"XCPU", SIGXCPU}};

class BrokenOutput : public Program {
 protected:
  void put_old_files(const Outputs& outputs) const {
    for (const std::string& name : outputs.names) write_file(name, kOld);
  }

  std::string names_of(const Outputs& outputs) const {
    std::string names;
    for (const std::string& name : outputs.names) names += name + " ";
    return names;
  }

  void remove_files() const {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
      if (entry.path().filename() != "cube.obj") fs::remove_all(entry.path());
    }
  }

  /// Fails unless all old files stand, and nothing else.
  void expect_old_files(const Outputs& outputs) const {
    for (const std::string& name : outputs.names) EXPECT_TRUE(read_file(name) == kOld) << name;
    EXPECT_EQ(files(), names_of(outputs));
  }

  /// Fails unless each file is the old one or, byte for byte, what `complete` has under its name.
  void expect_whole_files(const Outputs& outputs, const std::vector<std::string>& complete) const {
    for (std::size_t i = 0; i < outputs.names.size(); ++i) {
      const std::string now = read_file(outputs.names[i]);
      EXPECT_TRUE(now == kOld || now == complete[i]) << outputs.names[i] << " has " << now.size() << " bytes";
    }
  }

  std::vector<std::string> contents(const Outputs& outputs) const {
    std::vector<std::string> texts;
    for (const std::string& name : outputs.names) texts.push_back(read_file(name));
    return texts;
  }
};

TEST_F(BrokenOutput, ALimitOnFileSizesLeavesTheOldFiles) {
  for (const Outputs& outputs : kOutputs) {
    SCOPED_TRACE(outputs.flags);
    put_old_files(outputs);
    const Outcome outcome =
        run_shell("ulimit -f 8; \"$facemap\" render cube.obj --size 900x900 " + std::string(outputs.flags) + kView);
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find(": cannot write: File too large"), std::string::npos) << outcome.err;
    expect_old_files(outputs);
    remove_files();
  }
}

TEST_F(BrokenOutput, AFullDiskLeavesTheOldFiles) {
  const fs::path disk = folder_ / "disk";
  fs::create_directory(disk);
  if (::mount("none", disk.c_str(), "tmpfs", 0, "size=100k") != 0) {
    std::printf("a full disk: skipped, no file system may be mounted here\n");
    return;
  }
  for (const Outputs& outputs : kOutputs) {
    SCOPED_TRACE(outputs.flags);
    for (const std::string& name : outputs.names) write_file("disk/" + name, kOld);
    const Outcome outcome =
        run_shell(std::string(kFill) + "; cd disk; \"$facemap\" render ../cube.obj --size 900x900 " +
                  std::string(outputs.flags) + kView);
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find(": No space left on device"), std::string::npos) << outcome.err;
    for (const std::string& name : outputs.names) EXPECT_TRUE(read_file("disk/" + name) == kOld) << name;
    std::size_t count = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(disk)) count += fs::remove(entry.path());
    EXPECT_EQ(count, outputs.names.size() + 1) << "and nothing else";
  }
  EXPECT_EQ(::umount2(disk.c_str(), MNT_DETACH), 0);
}

TEST_F(BrokenOutput, APipeThatIsClosedEndsTheRun) {
  const Outcome outcome = run_shell("{ \"$facemap\" render cube.obj --size 1500x1500 -o - --format pfm --aov z=z.npy " +
                                    std::string(kView) + "; echo $? >code; } | head -c 1000 >part");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(read_file("code"), std::to_string(128 + SIGPIPE) + "\n");
  EXPECT_EQ(files(), "code part ");
}

TEST_F(BrokenOutput, WhatCannotBeWrittenIsFoundOutBeforeTheWork) {
  const std::string long_name(300, 'a');
  for (const char* end : {".png", ".jpg", ".exr", ".pfm", ".npy"}) {
    SCOPED_TRACE(end);
    const std::string render = "render cube.obj -q --size 8192x8192 --samples 8x8 -o ";  // would take long
    expect_error(run(render + "absent/a" + end), 1,
                 "absent/a" + std::string(end) + ": cannot write: there is no folder absent");
    expect_error(run_shell("mkdir -p folder" + std::string(end) + "; \"$facemap\" " + render + "folder" + end), 1,
                 "folder" + std::string(end) + ": cannot write: it is a folder");
    expect_error(run(render + long_name + end), 1, long_name + end + ": cannot write: File name too long");
  }
  const std::string longest(251, 'b');
  EXPECT_EQ(run("render cube.obj --size 8x8 -o " + longest + ".png" + kView).exit_code, 0)
      << "the system's limit is ours";
}

TEST_F(BrokenOutput, ADiskThatMayNotBeWrittenToIsFoundOutBeforeTheWork) {
  const fs::path disk = folder_ / "disk";
  fs::create_directory(disk);
  if (::mount("none", disk.c_str(), "tmpfs", MS_RDONLY, "size=48k") != 0) {
    std::printf("a disk that may not be written to: skipped, no file system may be mounted here\n");
    return;
  }
  expect_error(run("render cube.obj -q --size 8192x8192 --samples 8x8 -o disk/a.exr"), 1,
               "disk/a.exr: cannot write: Read-only file system");
  EXPECT_EQ(::umount2(disk.c_str(), MNT_DETACH), 0);
}

TEST_F(BrokenOutput, TooLittleMemoryLeavesTheOldFiles) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  std::printf("too little memory: skipped, a sanitizer takes more addresses than the limits allow\n");
  return;
#endif
  int failures = 0;
  for (const Outputs& outputs : kOutputs) {
    SCOPED_TRACE(outputs.flags);
    put_old_files(outputs);
    for (const int megabytes : {60, 90, 130, 180, 260}) {
      const Outcome outcome = run_shell("ulimit -v " + std::to_string(megabytes * 1024) +
                                        "; \"$facemap\" render cube.obj --threads 2 --size 1600x1600 " +
                                        std::string(outputs.flags) + kView);
      if (outcome.exit_code == 0) break;
      ++failures;
      EXPECT_TRUE(outcome.exit_code == 1 || outcome.exit_code == 127) << outcome.exit_code << outcome.err;
      expect_old_files(outputs);
    }
    remove_files();
  }
  EXPECT_GT(failures, 0);
}

TEST_F(BrokenOutput, SignalsLeaveWholeFilesAndNoTemporary) {
  constexpr std::uint64_t kSeed = 4711;
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  Random random(kSeed);
  int interrupted = 0;
  for (const Outputs& outputs : kOutputs) {
    SCOPED_TRACE(outputs.flags);
    const std::string command = "\"$facemap\" render cube.obj --size 900x900 " + std::string(outputs.flags) + kView;
    ASSERT_EQ(run_shell(command).exit_code, 0);
    const std::vector<std::string> complete = contents(outputs);
    for (const auto& [signal, number] : kSignals) {
      put_old_files(outputs);
      const std::string delay = std::to_string(random.between(0.01, 0.25));
      const Outcome outcome =
          run_shell("timeout --preserve-status -s " + std::string(signal) + " " + delay + " " + command);
      interrupted += outcome.exit_code != 0;
      EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 128 + number) << outcome.exit_code;
      expect_whole_files(outputs, complete);
      EXPECT_EQ(files(), names_of(outputs));
    }
    remove_files();
  }
  std::printf("%d of %zu runs were interrupted\n", interrupted, std::size(kSignals) * std::size(kOutputs));
}

TEST_F(BrokenOutput, AKillLeavesWholeFilesAndDoesNotDisturbTheNextRun) {
  constexpr std::uint64_t kSeed = 815;
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  Random random(kSeed);
  for (const Outputs& outputs : kOutputs) {
    SCOPED_TRACE(outputs.flags);
    const std::string command = "\"$facemap\" render cube.obj --size 900x900 " + std::string(outputs.flags) + kView;
    ASSERT_EQ(run_shell(command).exit_code, 0);
    const std::vector<std::string> complete = contents(outputs);
    put_old_files(outputs);
    for (int k = 0; k < 3; ++k) {
      run_shell("timeout -s KILL " + std::to_string(random.between(0.01, 0.25)) + " " + command);
      expect_whole_files(outputs, complete);
    }
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
      const std::string name = entry.path().filename();
      const bool is_output = std::find(outputs.names.begin(), outputs.names.end(), name) != outputs.names.end();
      EXPECT_TRUE(is_output || name == "cube.obj" || (name.front() == '.' && name.ends_with(".tmp"))) << name;
    }
    ASSERT_EQ(run_shell(command).exit_code, 0);
    EXPECT_TRUE(contents(outputs) == complete);
    remove_files();
  }
}

}  // namespace
