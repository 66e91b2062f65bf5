#include <unistd.h>

#include "cli/program.h"

namespace {

/// Long enough to be interrupted: 64 rays for each of 67 million pixels.
constexpr const char* kLongRender = "render cube.obj -q --size 8192x8192 --samples 8x8 ";

TEST_F(Program, NamesFileAndLineOfABadModel) {
  write_file("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  const Outcome outcome = run("render bad.obj -o a.png");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.err.find("facemap: bad.obj:4: "), 0u) << outcome.err;
  EXPECT_EQ(run("info bad.obj").err, outcome.err);

  write_file("empty.obj", "");
  for (const char* name : {"absent.obj", "empty.obj", "cube.xyz"}) {
    const Outcome refused = run(std::string("render ") + name + " -o a.png");
    EXPECT_EQ(refused.exit_code, 1) << name;
    EXPECT_EQ(refused.err.find(std::string("facemap: ") + name + ": "), 0u) << refused.err;
  }
  EXPECT_FALSE(exists("a.png"));
}

TEST_F(Program, RefusesToReplaceTheModel) {
  const std::string model = read_file("cube.obj");
  expect_error(run("render cube.obj -o cube.obj"), 2, "cube.obj: the output would replace the model");
  expect_error(run("render cube.obj -o ./cube.obj"), 2, "./cube.obj: the output would replace the model");
  expect_error(run_shell("ln -s cube.obj link.png; \"$facemap\" render cube.obj -o link.png"), 2,
               "link.png: the output would replace the model");
  expect_error(run("render cube.obj -o a.png --aov id=cube.obj"), 2, "cube.obj: the output would replace the model");
  expect_error(run("render cube.obj -o a.png --aov id=./a.png"), 2, "./a.png: two outputs name this file");
  EXPECT_EQ(read_file("cube.obj"), model);
}

TEST_F(Program, FindsOutBeforeTheWorkThatAnOutputCannotBeWritten) {
  expect_error(run(std::string(kLongRender) + "-o absent/a.png"), 1,
               "absent/a.png: cannot write: there is no folder absent");
  expect_error(run(std::string(kLongRender) + "-o a.png --aov id=absent/id.npy"), 1,
               "absent/id.npy: cannot write: there is no folder absent");
  expect_error(run_shell("mkdir folder.png; \"$facemap\" " + std::string(kLongRender) + "-o folder.png"), 1,
               "folder.png: cannot write: it is a folder");
  expect_error(run(std::string(kLongRender) + "-o a.tiff"), 2,
               "a.tiff: no format is known by the name .tiff; known are .png, .jpg, .jpeg, .exr, .pfm, .npy");
  expect_error(run("scene chessboard -o absent/a.obj"), 1, "absent/a.obj: cannot write: there is no folder absent");
  if (::geteuid() == 0) {
    std::printf("the folder without write permission: skipped, root may write anywhere\n");
    return;
  }
  expect_error(
      run_shell("mkdir closed; chmod 500 closed; \"$facemap\" " + std::string(kLongRender) + "-o closed/a.png"), 1,
      "closed/a.png: cannot write: Permission denied");
}

TEST_F(Program, AFullDiskLeavesTheOldPicture) {
  write_file("a.png", "old");
  const std::string flags = "render cube.obj -q --size 512x512 --samples edges -o ";
  const Outcome limited = run_shell("ulimit -f 1; \"$facemap\" " + flags + "a.png");
  expect_error(limited, 1, "a.png: cannot write: File too large");
  EXPECT_EQ(read_file("a.png"), "old");
  EXPECT_EQ(files(), "a.png ");
  expect_error(run(flags + "/dev/full"), 1, "/dev/full: cannot write: No space left on device");
  const Outcome scene = run_shell("ulimit -f 1; \"$facemap\" scene chessboard -o b.obj");
  EXPECT_EQ(scene.exit_code, 1);
  EXPECT_EQ(scene.err.find("facemap: b.obj: "), 0u) << scene.err;
  EXPECT_EQ(files(), "a.png ");
}

TEST_F(Program, AnInterruptLeavesTheOldPicture) {
  write_file("a.png", "old");
  const std::string render = "\"$facemap\" " + std::string(kLongRender) + "-o a.png";
  EXPECT_EQ(run_shell("timeout --preserve-status -s INT 0.5 " + render).exit_code, 128 + 2);
  EXPECT_EQ(run_shell("timeout --preserve-status -s TERM 0.5 " + render).exit_code, 128 + 15);
  EXPECT_EQ(
      run_shell("timeout --preserve-status -s TERM 1 \"$facemap\" scene chessboard --detail 16 -o b.obj").exit_code,
      128 + 15);
  EXPECT_EQ(read_file("a.png"), "old");
  EXPECT_EQ(files(), "a.png ");
}

TEST_F(Program, ShowsNoProgressInAPipe) {
  EXPECT_EQ(run("render cube.obj -o a.png --camera 3,2,5 --look-at 0,0,0 --light 4,6,3 --size 512x512").err, "");
}

}  // namespace
