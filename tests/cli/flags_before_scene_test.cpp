#include "cli/program.h"

namespace {

/// A scene file's settings give way to what flags say in their place, also in other words.
class FlagsBeforeScene : public Program {
 protected:
  std::string picture(const std::string& arguments) const {
    const Outcome outcome = run("render " + arguments + " -o p.png -q");
    EXPECT_EQ(outcome.exit_code, 0) << arguments << "\n" << outcome.err;
    return outcome.exit_code == 0 ? read_file("p.png") : "";
  }
};

TEST_F(FlagsBeforeScene, OfTheLens) {
  ASSERT_EQ(run("render cube.obj -o y.png --size 40x20 --save-scene y.toml -q").exit_code, 0);
  const std::string saved = picture("y.toml");
  EXPECT_EQ(saved, read_file("y.png"));
  for (const std::string lens :
       {"equirect", "orthographic", "plane", "cube --size 30x20", "opencv --camera-matrix 20,20,20,10"}) {
    EXPECT_NE(picture("y.toml --lens " + lens), saved) << lens;
  }
  EXPECT_NE(picture("y.toml --projection surface"), picture("y.toml --projection plane"));
  write_file("matrix.toml",
             "[[model]]\npath = \"cube.obj\"\n[settings]\nsize = \"40x20\"\nlens = \"opencv\"\n"
             "camera_matrix = [20, 20, 20, 10]\ndistortion = [0.1, 0.01, 0, 0]\n");
  EXPECT_EQ(picture("matrix.toml --lens plane"), picture("cube.obj --size 40x20 --lens plane"));
}

TEST_F(FlagsBeforeScene, OfTheHeightOfAnOrthographicCamera) {
  const std::string camera = "position = [0, 0, 5]\nlook_at = [0, 0, 0]\n";
  write_file("s.toml", "[[model]]\npath = \"cube.obj\"\n[[camera]]\n" + camera + "[[camera]]\n" + camera +
                           "lens = \"orthographic\"\northo_height = 9\n");
  EXPECT_EQ(picture("s.toml --size 20x20 --camera-name 1 --ortho-height 3"),
            picture("cube.obj --size 20x20 --camera 0,0,5 --look-at 0,0,0 --lens orthographic --ortho-height 3"));
  expect_error(run("render s.toml --camera-name 0 --ortho-height 3 -o q.png"), 2,
               "--ortho-height is for --lens orthographic, not for --lens surface");
}

TEST_F(FlagsBeforeScene, OfTheCamerasPlace) {
  const std::string pose = " --opencv-pose 1,0,0,0,0,-1,0,0,0,0,-1,6";
  ASSERT_EQ(run("render cube.obj -o y.png --size 20x20 --save-scene y.toml --up z -q").exit_code, 0);
  EXPECT_NE(picture("y.toml" + pose), read_file("y.png"));
  // The world's up stays: the ground lies where it lay.
  write_file("up.toml",
             "[[model]]\npath = \"cube.obj\"\n[ground]\n[settings]\nsize = \"20x20\"\nup = \"z\"\n"
             "sky = \"0.9,0.5,0.1,0,0,0.3\"\n");
  write_file("no_up.toml",
             "[[model]]\npath = \"cube.obj\"\n[ground]\n[settings]\nsize = \"20x20\"\nsky = \"0.9,0.5,0.1,0,0,0.3\"\n");
  EXPECT_NE(picture("up.toml" + pose), picture("no_up.toml" + pose));
}

TEST_F(FlagsBeforeScene, OfThePictureAsPart) {
  write_file("crop.toml", "[[model]]\npath = \"cube.obj\"\n[settings]\nsize = \"20x20\"\ncrop = \"0,0,5x5\"\n");
  write_file("tile.toml", "[[model]]\npath = \"cube.obj\"\n[settings]\nsize = \"20x20\"\ntile = \"1/2\"\n");
  EXPECT_EQ(picture("crop.toml --tile 1/2"), picture("cube.obj --size 20x20 --tile 1/2"));
  EXPECT_EQ(picture("tile.toml --crop 0,0,5x5"), picture("cube.obj --size 20x20 --crop 0,0,5x5"));
}

TEST_F(FlagsBeforeScene, AnglesOfSeveralCamerasAreSavedWithThem) {
  const std::string many = " --size 16x16 -q -o ";
  ASSERT_EQ(run("render cube.obj --camera 3,2,5 --camera 0,2,6 --field-angle 30 --field-angle 60 --save-scene s.toml" +
                many + "a{n}.png")
                .exit_code,
            0);
  const Outcome again = run("render s.toml" + many + "b{n}.png");
  ASSERT_EQ(again.exit_code, 0) << again.err << read_file("s.toml");
  EXPECT_EQ(read_file("a0.png"), read_file("b0.png"));
  EXPECT_EQ(read_file("a1.png"), read_file("b1.png"));
}

}  // namespace
