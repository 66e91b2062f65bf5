#include "cli/program.h"

namespace {

constexpr const char* kView = " --camera 3,2,5 --look-at 0,0,0 --light 4,6,3 --size 48x32 -q ";

std::string render(const std::string& flags) { return "render cube.obj " + flags + kView; }

TEST_F(Program, FiltersAndEdgesMakeNearlyTheSamePicture) {
  ASSERT_EQ(run(render("-o grid.png --samples 4x4")).exit_code, 0);
  ASSERT_EQ(run(render("-o edges.png --samples edges:4")).exit_code, 0);
  ASSERT_EQ(run(render("-o soft.png --samples 4x4 --filter blackman-harris")).exit_code, 0);
  ASSERT_EQ(run(render("-o softer.png --samples 4x4 --filter blackman-harris --filter-width 3")).exit_code, 0);
  EXPECT_EQ(run("compare grid.png edges.png --threshold 4 --max-different 0").exit_code, 0);
  EXPECT_EQ(run("compare grid.png soft.png --mean-threshold 2").exit_code, 0);
  EXPECT_EQ(run("compare grid.png soft.png --threshold 4 --max-different 0").exit_code, 1);
  EXPECT_EQ(run("compare soft.png softer.png --threshold 4 --max-different 0").exit_code, 1);
  expect_error(run(render("-o a.png --filter-width 0")), 2, "--filter-width: '0' is not a width above 0 to 16 pixels");
}

TEST_F(Program, ExposureCurveAndTransferAreOfLevelsAlone) {
  ASSERT_EQ(run(render("-o plain.png")).exit_code, 0);
  ASSERT_EQ(run(render("-o half.png --exposure -1")).exit_code, 0);
  ASSERT_EQ(run(render("-o film.png --curve filmic")).exit_code, 0);
  ASSERT_EQ(run(render("-o linear.png --transfer linear")).exit_code, 0);
  for (const char* name : {"half.png", "film.png", "linear.png"}) {
    EXPECT_NE(read_file(name), read_file("plain.png")) << name;
    EXPECT_EQ(run(std::string("compare plain.png ") + name + " --threshold 4 --max-different 0").exit_code, 1);
  }
  ASSERT_EQ(run(render("-o half16.png --exposure -1 --bits 16")).exit_code, 0);
  EXPECT_EQ(run("compare half.png half16.png --threshold 0.5 --max-different 0").exit_code, 0);
  ASSERT_EQ(run(render("-o half.jpg --exposure -1 --quality 100")).exit_code, 0);
  EXPECT_EQ(run("compare half.png half.jpg --mean-threshold 4").exit_code, 0);
  ASSERT_EQ(run(render("-o plain.exr")).exit_code, 0);
  ASSERT_EQ(run(render("-o half.exr --exposure -1 --curve filmic --transfer linear")).exit_code, 0);
  EXPECT_EQ(read_file("plain.exr"), read_file("half.exr"));
  expect_error(run(render("-o a.jpg --transfer linear")), 2,
               "--transfer linear: a JPEG file cannot say so; write .png");
  expect_error(run(render("-o a.png --exposure 99")), 2, "--exposure: '99' is not -64 to 64 stops");
}

}  // namespace
