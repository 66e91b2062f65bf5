#include <facemap/image.h>

#include <algorithm>

#include "cli/program.h"

namespace {

constexpr const char* kLight = " --light 4,6,3 --size 40x32 -q ";

TEST_F(Program, SeveralCamerasGiveWhatEachGivesAlone) {
  const std::string cameras[] = {"3,2,5", "-3,2,5", "0.5,4,-3"};
  std::string all;
  for (const std::string& camera : cameras) all += " --camera " + camera;
  const Outcome outcome =
      run("render cube.obj -o a{n}.png --aov id={n}.npy --aov lights=l{n}.npy --look-at 0,0.5,0" + all + kLight);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out + outcome.err, "");
  EXPECT_EQ(files(), "0.npy 1.npy 2.npy a0.png a1.png a2.png l0.npy l1.npy l2.npy ");
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(run("render cube.obj -o b.png --aov id=b.npy --aov lights=lb.npy --look-at 0,0.5,0 --camera " +
                  cameras[i] + kLight)
                  .exit_code,
              0);
    const std::string n = std::to_string(i);
    EXPECT_EQ(read_file("a" + n + ".png"), read_file("b.png")) << i;
    EXPECT_EQ(read_file(n + ".npy"), read_file("b.npy")) << i;
    EXPECT_EQ(read_file("l" + n + ".npy"), read_file("lb.npy")) << i;
  }
  EXPECT_NE(read_file("a0.png"), read_file("a1.png"));
}

TEST_F(Program, EachCameraMayHaveItsOwnRest) {
  const Outcome outcome =
      run("render cube.obj -o a{n}.png --camera 3,2,5 --look-at 0,0,0 --field-angle 30 --up 0,1,0 "
          "--camera 0,9,1 --look-at 0,1,0 --field-angle 70 --up 1,0,0" +
          std::string(kLight));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  run("render cube.obj -o b.png --camera 0,9,1 --look-at 0,1,0 --field-angle 70 --up 1,0,0" + std::string(kLight));
  EXPECT_EQ(read_file("a1.png"), read_file("b.png"));

  const std::string two = "render cube.obj -o a{n}.png --camera 1,2,3 --camera 3,2,1 ";
  expect_error(run(two + "--look-at 0,0,0 --look-at 1,0,0 --look-at 2,0,0"), 2,
               "--look-at is given 3 times, --camera 2 times; give it once for all cameras or once for each");
  expect_error(run("render cube.obj -o a.png --up 0,1,0 --up 0,0,1"), 2,
               "--up is given 2 times, --camera not at all; give it once for all cameras or once for each");
  expect_error(run("render cube.obj -o a.png --camera 1,2,3 --field-angle 9 --field-angle 8"), 2,
               "--field-angle is given 2 times, --camera once; give it once for all cameras or once for each");
}

TEST_F(Program, SaysWhatItMadeUpForEachCamera) {
  const std::string err = run("render cube.obj -o a{n}.png --size 8x8 --camera 3,2,5 --camera 0,9,0").err;
  EXPECT_NE(err.find("facemap: view: --camera 3,2,5 --look-at 0,0,0 --up 0,1,0"), std::string::npos) << err;
  EXPECT_NE(err.find("facemap: view: --camera 0,9,0 --look-at 0,0,0 --up 0,0,1"), std::string::npos) << err;
  EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 3) << "and once what holds for all: the lights\n" << err;
}

TEST_F(Program, ATurntableGoesAroundTheModel) {
  const std::string view = " --camera 3,2,5 --look-at 0,0,0 ";
  ASSERT_EQ(run("render cube.obj -o t{n}.png --turntable 10" + view + kLight).exit_code, 0);
  EXPECT_EQ(files(), "t00.png t01.png t02.png t03.png t04.png t05.png t06.png t07.png t08.png t09.png ");
  ASSERT_EQ(run("render cube.obj -o a.png" + view + kLight).exit_code, 0);
  EXPECT_EQ(read_file("t00.png"), read_file("a.png")) << "the first is the given view";
  ASSERT_EQ(run("render cube.obj -o b.png --camera -3,2,-5 --look-at 0,0,0" + std::string(kLight)).exit_code, 0);
  EXPECT_EQ(read_file("t05.png"), read_file("b.png")) << "half-way it stands on the other side";
  EXPECT_NE(read_file("t01.png"), read_file("t09.png"));

  const std::string err = run("render cube.obj -o t{n}.png --turntable 3 --size 8x8").err;
  EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 2) << "the first view and the lights\n" << err;
  expect_error(run("render cube.obj -o t{n}.png --turntable 3 --camera 1,2,3 --camera 3,2,1"), 2,
               "--turntable turns one camera; --camera is given more often");
  expect_error(run("render cube.obj -o t{n}.png --turntable 0"), 2,
               "--turntable: '0' is not a whole number of 1 to 100000");
}

TEST_F(Program, FramesNeedNamesOfTheirOwn) {
  const std::string turn = "render cube.obj --turntable 3 --size 8x8 -q ";
  expect_error(run(turn + "-o a.png"), 2,
               "a.png: the names of 3 pictures need {n}, the picture's number, such as a_{n}.png");
  expect_error(run(turn + "-o a{n}.png --aov id=id.npy"), 2,
               "id.npy: the names of 3 pictures need {n}, the picture's number, such as id_{n}.npy");
  expect_error(run(turn + "-o -"), 2, "-o -: standard output takes one picture, not 3");
  expect_error(run(turn + "-o {n}.npy --aov id={n}.npy"), 2, "0.npy: two outputs name this file");
  expect_error(run("render cube.obj --turntable 12 -o a{n}1.png --aov id=a0{n}.png"), 2,
               "a001.png: two outputs name this file");
  expect_error(run(turn + "-o absent/{n}.png"), 1, "absent/0.png: cannot write: there is no folder absent");
  expect_error(run_shell("cp cube.obj 1.obj; \"$facemap\" render 1.obj --turntable 3 -o {n}.obj"), 2,
               "1.obj: the output would replace the model");
  EXPECT_EQ(files(), "1.obj ");

  EXPECT_EQ(run("render cube.obj -o {n}_{n}.png --turntable 1 --size 8x8 -q").exit_code, 0);
  EXPECT_EQ(files(), "0_0.png 1.obj ") << "one picture has a number, too";
}

TEST_F(Program, AnInterruptLeavesTheFramesThatAreComplete) {
  constexpr int kFrames = 9999;  // minutes of work, a few milliseconds each
  const Outcome outcome = run_shell(
      "timeout --preserve-status -s INT 1 \"$facemap\" render cube.obj -q --size 256x256 -o a{n}.png --aov id=i{n}.npy "
      "--turntable " +
      std::to_string(kFrames));
  EXPECT_EQ(outcome.exit_code, 128 + 2);
  EXPECT_EQ(files().find("tmp"), std::string::npos) << files();
  int complete = 0;
  for (int i = 0; i < kFrames; ++i) {
    const std::string number = std::to_string(10000 + i).substr(1);
    const bool has_picture = exists("a" + number + ".png");
    EXPECT_EQ(exists("i" + number + ".npy"), has_picture) << number;
    if (!has_picture) continue;
    EXPECT_EQ(complete++, i) << "one after the other";
    EXPECT_EQ(facemap::read_png(folder_ / ("a" + number + ".png")).width, 256);
  }
  EXPECT_LT(complete, kFrames);
}

TEST_F(Program, AFailureToWriteAFrameEndsTheRun) {
  const Outcome limited = run_shell(
      "ulimit -f 1; \"$facemap\" render cube.obj -q --size 256x256 --samples edges --turntable 5 -o a{n}.png");
  expect_error(limited, 1, "a0.png: cannot write: File too large");
  EXPECT_EQ(files(), "");
}

}  // namespace
