#include "cli/program.h"

namespace {

TEST_F(Program, WrongValuesOfFlagsAreNamedWithTheFlag) {
  const std::pair<std::string, std::string> cases[] = {
      {"--intensity -1", "--intensity: '-1' is not a number of 0 or more"},
      {"--light 1,2,3,-1,0,0", "--light: '1,2,3,-1,0,0': a colour's value is below 0"},
      {"--sun 1,2,3,0,-1,0", "--sun: '1,2,3,0,-1,0': a colour's value is below 0"},
      {"--background=-1,-1,-1", "--background: '-1,-1,-1' is not a colour: a value is below 0"},
      {"--ambient -1,0,0", "--ambient: '-1,0,0' is not a colour: a value is below 0"},
      {"--lens orthographic --ortho-height 0", "--ortho-height: '0' is not a number above 0"},
      {"--lens plane --field-angle 180", "--field-angle: a plane picture shows less than 180 degrees"},
      {"--projection plane --field-angle 200", "--field-angle: a plane picture shows less than 180 degrees"},
      {"--camera 0,0,0 --look-at 0,0,0", "--look-at: the camera stands at the point that it looks at"},
      {"--camera 0,0,5 --look-at 0,0,0 --up z", "--up: up is parallel to the line of sight, or zero"},
  };
  for (const auto& [flags, message] : cases) expect_error(run("render cube.obj -o p.png " + flags), 2, message);
  const Outcome matrix = run("render cube.obj -o p.png --lens opencv --camera-matrix 0,0,0,0");
  EXPECT_EQ(matrix.exit_code, 2);
  EXPECT_EQ(matrix.err.substr(0, 26), "facemap: --camera-matrix: ");
  const Outcome distortion = run("render cube.obj -o p.png --lens opencv --camera-matrix 9,9,9,9 --distortion 1,2,3");
  EXPECT_EQ(distortion.exit_code, 2);
  EXPECT_EQ(distortion.err.substr(0, 40), "facemap: --camera-matrix, --distortion: ");
  EXPECT_EQ(files(), "");
}

TEST_F(Program, TooLargeAModelForTheStudioIsSaid) {
  write_file("huge.obj", "v 0 0 0\nv 3e38 0 0\nv 0 3e38 0\nf 1 2 3\n");
  expect_error(run("huge.obj"), 1, "huge.obj: its coordinates are too large for a view to be made up");
}

TEST_F(Program, WrongValuesOfSceneFilesAreSaidWithTheirPlace) {
  const std::string model = "[[model]]\npath = \"cube.obj\"\n";
  const std::pair<std::string, std::string> cases[] = {
      {"matrix = [[1, 0, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]\n",
       "s.toml:3:10: [[model]]'s transform flattens the model"},
      {"[[light]]\nposition = [0, 0, 9]\nintensity = -1\n", "s.toml:5:13: is below 0"},
      {"[[light]]\nposition = [0, 0, 9]\ncolor = [-1, 0, 0]\n", "s.toml:5:9: has a value below 0"},
      {"[[camera]]\nlens = \"plane\"\nfield_angle = 200\n",
       "s.toml:5:1: --field-angle: a plane picture shows less than 180 degrees"},
      {"[[camera]]\nposition = [0, 0, 5]\nlook_at = [0, 0, 5]\n",
       "s.toml:3:1: [[camera]] stands at the point that it looks at"},
      {"[[camera]]\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\nup = \"z\"\n",
       "s.toml:3:1: [[camera]]: up is parallel to the line of sight, or zero"},
      {"[settings]\nsize = \"8x8\"\ncrop = \"4,4,8x8\"\n", "s.toml:5:1: --crop reaches beyond a picture of 8x8"},
  };
  for (const auto& [text, message] : cases) {
    write_file("s.toml", model + text);
    expect_error(run("render s.toml -o p.png"), 1, message);
  }
  write_file("s.toml", model + "[[camera]]\npositon = [0, 0, 5]\n");
  const std::string err = run("render s.toml -o p.png").err;
  EXPECT_NE(err.find("unknown key \"positon\" in [[camera]]; did you mean position?"), std::string::npos) << err;
}

TEST_F(Program, TooManySettingsAreRefused) {
  const std::string model = "[[model]]\npath = \"cube.obj\"\n";
  std::string angles = "field_angle = [\"30\"", keys;
  for (int i = 0; i < 200'000; ++i) angles += ",\"30\"";
  for (int i = 0; i < 200'000; ++i) keys += "k" + std::to_string(i) + " = 1\n";
  write_file("s.toml", model + "[settings]\n" + angles + "]\n");
  expect_error(run("render s.toml -o p.png"), 1, "s.toml:4:15: has more than 1000 values");
  write_file("s.toml", model + "[settings]\n" + keys);
  const std::string err = run("render s.toml -o p.png").err;
  EXPECT_NE(err.find(": more than 1000 settings\n"), std::string::npos) << err.substr(0, 200);
}

TEST_F(Program, StatisticsAreUTF8WhateverTheModelIsCalled) {
  const Outcome outcome = run_shell(
      "bad=$(printf 'bad\\377.obj'); cp cube.obj \"$bad\"; "
      "\"$facemap\" render \"$bad\" -o p.png --size 8x8 -q --stats json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("\"bad\\ufffd.obj\""), std::string::npos) << outcome.out;
}

}  // namespace
