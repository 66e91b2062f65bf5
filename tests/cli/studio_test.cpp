#include <facemap/image.h>

#include <algorithm>

#include "cli/program.h"

namespace {

TEST_F(Program, AModelAloneIsDrawnInTheStudio) {
  const Outcome outcome = run("cube.obj --size 64x64");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(files(), "cube.png ");
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("facemap: picture: cube.png\n"), std::string::npos) << outcome.err;
  EXPECT_EQ(run("render cube.obj --studio --size 64x64 -q -o b.png").exit_code, 0);
  EXPECT_EQ(read_file("cube.png"), read_file("b.png"));
}

TEST_F(Program, TheCommandThatTheStudioPrintsMakesTheSamePicture) {
  for (const std::string flags : {"", "--up z --light 4,6,3", "--camera 3,2,5 --samples 2x2", "--ground none"}) {
    const std::string err = run("cube.obj --size 64x48 " + flags).err;
    const std::string before = "the same again: facemap ";
    const std::size_t at = err.find(before);
    ASSERT_NE(at, std::string::npos) << err;
    std::string command = err.substr(at + before.size());
    command.resize(command.find('\n'));
    const std::string picture = read_file("cube.png");
    EXPECT_EQ(run(command + " -q").exit_code, 0) << command;
    EXPECT_EQ(read_file("cube.png"), picture) << command;
  }
}

TEST_F(Program, TheStudioReplacesOnlyPicturesOfItsOwn) {
  ASSERT_EQ(run("cube.obj --size 16x16 -q").exit_code, 0);
  EXPECT_EQ(run("cube.obj --size 17x17 -q").exit_code, 0);
  write_file("cube.png", "a texture");
  expect_error(run("cube.obj"), 1,
               "cube.png: there is such a file that facemap did not write; name the picture with -o");
  EXPECT_EQ(read_file("cube.png"), "a texture");
  EXPECT_EQ(run("cube.obj --size 16x16 -q -o other.png").exit_code, 0);
}

TEST_F(Program, WhatIsNoModelIsNoCommandEither) {
  expect_error(run("castle.obj"), 1, "castle.obj: No such file or directory");
  expect_error(run("castle"), 2, "unknown command castle");
}

TEST_F(Program, LimitsAreNamedWithTheirFlags) {
  expect_error(run("render cube.obj -o a.png --max-faces 3"), 1,
               "cube.obj:10: more than 3 triangles (--max-faces sets the limit)");
  expect_error(run("render cube.obj -o a.png --max-bytes 10"), 1,
               "cube.obj: more than 10 bytes (--max-bytes sets the limit)");
  expect_error(run("render cube.obj -o a.png --size 100x100 --max-pixels 9999"), 2,
               "--size: '100x100' is not a size this program takes: 9999 pixels at most (--max-pixels)");
  EXPECT_EQ(run("render cube.obj -o a.png --size 8x8 --max-faces 12 --max-bytes 1M -q").exit_code, 0);
}

TEST_F(Program, MessagesMayBeJson) {
  const Outcome outcome = run("render cube.obj -o a.png --size 16x16 --log-json --verbose");
  ASSERT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("{\"event\": \"note\", \"message\": \"lights: --light "), std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("{\"event\": \"note\", \"message\": \"read cube.obj in "), std::string::npos);
  EXPECT_NE(outcome.err.find("{\"event\": \"done\", \"seconds\": "), std::string::npos);
  for (std::size_t start = 0, end; start < outcome.err.size(); start = end + 1) {
    end = outcome.err.find('\n', start);
    EXPECT_EQ(outcome.err.substr(start, 11), "{\"event\": \"") << outcome.err;
    EXPECT_EQ(outcome.err[end - 1], '}');
  }
  const Outcome failed = run("render absent.obj -o a.png --log-json");
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_EQ(failed.err, "{\"event\": \"error\", \"message\": \"absent.obj: No such file or directory\"}\n");
  expect_error(run("render cube.obj -o a.png -q -v"), 2, "--quiet and --verbose are given");
}

TEST_F(Program, VerboseSaysWhatWasReadAndDrawn) {
  const std::string err = run("render cube.obj -o a.png --size 16x16 --verbose").err;
  EXPECT_NE(err.find("12 triangles, 12 of them drawn"), std::string::npos) << err;
  EXPECT_NE(err.find("facemap: drawn: camera "), std::string::npos) << err;
}

}  // namespace
