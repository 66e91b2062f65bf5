// Lights on the command line: spot lights, directional lights, ranges.

#include "cli/program.h"

namespace {

constexpr const char* kView = " --camera 3,2,5 --look-at 0,0,0 --size 48x32 -q ";

// Point lights have the first bits of a light mask, then come spots, then directional lights.
TEST_F(Program, LightsComeByTheirKinds) {
  ASSERT_EQ(run(std::string("render cube.obj -o a.png --aov lights=a.npy --spot 0,5,5,0,-1,-1,60,40,1,0.5,0.5 "
                            "--sun 1,-2,-1,0,0,1 --light 4,6,3") +
                kView)
                .exit_code,
            0);
  ASSERT_EQ(run(std::string("render cube.obj -o b.png --aov lights=b.npy --light 4,6,3 "
                            "--spot 0,5,5,0,-1,-1,60,40,1,0.5,0.5 --sun 1,-2,-1,0,0,1") +
                kView)
                .exit_code,
            0);
  const std::string a = read_file("a.npy"), b = read_file("b.npy");
  ASSERT_EQ(a.size(), b.size());
  std::size_t lit = 0, in_one_alone = 0;
  for (std::size_t i = a.size() - 48 * 32; i < a.size(); ++i) {
    const int first = a[i], second = b[i];
    EXPECT_EQ(first, second);
    lit += first == 7;
    in_one_alone += first == 1;
  }
  EXPECT_GT(lit, 10u);
  EXPECT_GT(in_one_alone, 10u);
}

// A cone all around is a point light of the same strength, and an inner angle may be left out before a colour.
TEST_F(Program, SpotsTakeAngleInnerAngleAndColour) {
  const auto picture = [&](const std::string& lights) {
    const Outcome outcome = run("render cube.obj -o a.png " + lights + kView);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return read_file("a.png");
  };
  EXPECT_EQ(picture("--spot 4,6,3,-4,-6,-3,180,150"), picture("--light 4,6,3"));
  EXPECT_EQ(picture("--spot 4,6,3,-4,-6,-3,20,1,0.5,0.25"), picture("--spot 4,6,3,-4,-6,-3,20,0,1,0.5,0.25"));
  EXPECT_EQ(picture("--spot 4,6,3,-4,-6,-3,20"), picture("--spot 4,6,3,-4,-6,-3,20,0,1,1,1"));
  EXPECT_NE(picture("--spot 4,6,3,-4,-6,-3,20"), picture("--spot 4,6,3,-4,-6,-3,20,20"));
  EXPECT_EQ(picture("--light 4,6,3,falloff"), picture("--light 4,6,3 --falloff inverse-square"));
  EXPECT_NE(picture("--light 4,6,3,1,1,1,range=8"), picture("--light 4,6,3"));
  EXPECT_EQ(picture("--light 4,6,3,1,1,1,range=1e9,falloff"), picture("--light 4,6,3,1,1,1,falloff,range=1e9"));
}

TEST_F(Program, RefusesLightsThatAreNone) {
  const auto refuses = [&](const std::string& flag, const std::string& reason) {
    const Outcome outcome = run("render cube.obj -o a.png " + flag + kView);
    EXPECT_EQ(outcome.exit_code, 2) << flag;
    EXPECT_NE(outcome.err.find(reason), std::string::npos) << flag << ": " << outcome.err;
  };
  refuses("--light 1,2", "'1,2' is not a light x,y,z or x,y,z,r,g,b");
  refuses("--light 1,2,3,4", "is not a light");
  refuses("--light 1,2,3,range=-1", "is not a light");
  refuses("--light 1,2,3,range=", "is not a light");
  refuses("--spot 1,2,3,4,5,6", "is not a spot light");
  refuses("--spot 1,2,3,4,5,6,7,8,9", "is not a spot light");
  refuses("--spot 1,2,3,0,0,0,40", "the direction is zero");
  refuses("--spot 1,2,3,0,0,1,40,50", "angles are 0 to 360 degrees, the inner one within the outer");
  refuses("--spot 1,2,3,0,0,1,400", "angles are 0 to 360 degrees");
  refuses("--sun 0,0,0", "the direction is zero");
  refuses("--sun 1,2,x", "'1,2,x' is not a directional light dx,dy,dz or dx,dy,dz,r,g,b");
  refuses("--sun 1,2,3,falloff", "is not a directional light");
}

}  // namespace
