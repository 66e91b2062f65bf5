#include <facemap/image.h>

#include <algorithm>
#include <set>

#include "cli/program.h"

namespace {

TEST_F(Program, InfoSaysWhatIsOdd) {
  write_file("odd.obj",
             "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nl 1 2\n"
             "f 1 2 3\nf 3 2 1\nf 1 2 4\nf 1 1 2\n");
  const Outcome outcome = run("info odd.obj");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* line :
       {"  vertices              4\n", "  triangles             4\n", "  kept                  1 triangles",
        "  left out              1 faces of zero area\n", "  left out              1 faces that name a vertex twice\n",
        "  left out              1 faces that repeat another's positions\n",
        "  ignored               l, 1 times, first in line 5\n", "  box to                1,1,0\n"}) {
    EXPECT_NE(outcome.out.find(line), std::string::npos) << line << "in\n" << outcome.out;
  }
}

TEST_F(Program, MapCountsFacesInEachDirection) {
  const Outcome outcome = run("map cube.obj --at 0,0,0 -o a.png --size 64x64");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("at most "), std::string::npos);
  const facemap::Picture24 picture = facemap::read_png(folder_ / "a.png");
  EXPECT_EQ(picture.width, 64);
  EXPECT_GT(picture.height, 64) << "a legend is below";
  EXPECT_EQ(picture.pixels[0], 0xbcd0e0u) << "a corner lies outside of 360 degrees";
  const std::uint32_t one = picture.pixels[20 * 64 + 25];
  EXPECT_TRUE(one != 0xffffffu && one != 0xbcd0e0u) << "a cube about the point is met in every direction";

  EXPECT_EQ(run("map cube.obj --at 0,0,9 -o b.png --size 64x64 -q").err, "");
  EXPECT_EQ(facemap::read_png(folder_ / "b.png").pixels[32 * 64 + 4], 0xffffffu) << "nothing is behind it";
  EXPECT_EQ(run("map cube.obj --at 0,0,9 -o - --size 64x64 -q").out, read_file("b.png"));
}

TEST_F(Program, SceneWritesAModelAndTheFlagsOfItsView) {
  for (const char* name : {"chessboard", "grass", "bust", "typewriter"}) {
    const Outcome outcome = run(std::string("scene ") + name + " -o a.obj");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out.find("--camera "), 0u);
    const std::string flags = outcome.out.substr(0, outcome.out.size() - 1);
    EXPECT_NE(read_file("a.obj").find("# facemap render a.obj " + flags), std::string::npos);
    EXPECT_EQ(run("render a.obj -o a.png --size 32x32 " + flags).err, "") << "nothing is left to make up";
    const facemap::Picture24 picture = facemap::read_png(folder_ / "a.png");
    EXPECT_GT(std::set<std::uint32_t>(picture.pixels.begin(), picture.pixels.end()).size(), 20u) << name;
  }
  EXPECT_EQ(files(), "a.obj a.png ");
  expect_error(run("scene bust --detail 0 -o a.obj"), 2, "--detail: '0' is not a whole number of 1 to 24");
}

TEST_F(Program, SceneGoesToStandardOutputToo) {
  ASSERT_EQ(run("scene chessboard -o model.obj").exit_code, 0);
  EXPECT_EQ(run("scene chessboard -o -").out, read_file("model.obj"));
  expect_error(run_shell("\"$facemap\" scene chessboard -o - >/dev/full"), 1,
               "standard output: cannot write: No space left on device");
}

}  // namespace
