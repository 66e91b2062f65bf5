#include "cli/program.h"

namespace {

TEST_F(Program, AModelAloneHasTheHelpOfRender) {
  const std::string help = run("render --help").out;
  for (const std::string flag : {"--help", "-h", "--size 8x8 --help"}) {
    const Outcome outcome = run("cube.obj " + flag);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, help);
  }
  EXPECT_EQ(files(), "");
}

TEST_F(Program, BracesInAModelsNameStandForThemselves) {
  for (const std::string name : {"{n}", "a{b}", "{model}"}) {
    std::filesystem::copy_file(folder_ / "cube.obj", folder_ / (name + ".obj"));
    const Outcome outcome = run("'" + name + ".obj' --size 8x8");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(exists(name + ".png"));
    EXPECT_NE(outcome.err.find("picture: " + name + ".png\n"), std::string::npos) << outcome.err;
  }
}

TEST_F(Program, RangesOfPicturesEndWhereRunsDo) {
  const std::string reason = " goes beyond the 100000 pictures that a run can have";
  expect_error(run("render cube.obj -o a{n}.png --frames 0..999999999"), 2, "--frames: '0..999999999'" + reason);
  expect_error(run("render cube.obj -o a{n}.png --frames 100000"), 2, "--frames: '100000'" + reason);
  expect_error(run("render cube.obj -o a{n}.png --turntable 4 --frames 0..99999"), 2,
               "--frames 99999: the pictures are numbered 0 to 3");
}

TEST_F(Program, NothingDrawnOnASheetIsAFailure) {
  expect_error(run("sheet absent.obj cube.obj -o s.png"), 1, "absent.obj: there is no such file or folder");
  EXPECT_EQ(files(), "");
  write_file("bad.obj", "v 1 2\n");
  EXPECT_EQ(run("sheet bad.obj -o s.png -q").exit_code, 1);
  EXPECT_EQ(run("sheet bad.obj cube.obj -o s.png -q --size 32x32 --columns 1000").exit_code, 0);
}

TEST_F(Program, ErrorsOfTheCommandLineMayBeJsonToo) {
  const Outcome outcome = run("render cube.obj --log-json --sise 4x4");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err.substr(0, 50), "{\"event\": \"error\", \"message\": \"unknown option --si");
  EXPECT_EQ(run("render --log-json").err.substr(0, 30), "{\"event\": \"error\", \"message\": ");
}

TEST_F(Program, WordsAreTakenAsElsewhere) {
  EXPECT_EQ(run("render cube.obj -o=a.png --size 8x8 -q").exit_code, 0);
  EXPECT_EQ(run("render -q --size 8x8 -o b.png -- cube.obj").exit_code, 0);
  EXPECT_EQ(files(), "a.png b.png ");
}

TEST_F(Program, APipeInThePicturesPlaceIsNotRead) {
  ASSERT_EQ(run_shell("mkfifo cube.png").exit_code, 0);
  expect_error(run("cube.obj"), 1,
               "cube.png: there is such a file that facemap did not write; name the picture with -o");
}

}  // namespace
