#include <algorithm>

#include "cli/program.h"

namespace {

/// Something without symmetry, on the floor y = 0, with another in front of it.
constexpr const char* kCorner =
    "v 0 0 0\nv 2 0 0\nv 0 1 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
    "v 1 0 1\nv 1.5 0 1\nv 1 0.75 1\nv 1 0 1.5\nf 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8\n";

/// A glTF file of one triangle with two cameras and a light.
constexpr const char* kGltf = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2, 3]}],
"extensionsUsed": ["KHR_lights_punctual"],
"extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 20}]}},
"nodes": [{"mesh": 0}, {"camera": 0, "translation": [0.2, 0.3, 3]}, {"camera": 1, "translation": [0.5, 0.5, 6]},
{"translation": [0, 0, 4], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
"cameras": [{"name": "near", "type": "perspective", "perspective": {"yfov": 0.71, "znear": 0.1}},
{"name": "far", "type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
"bufferViews": [{"buffer": 0, "byteLength": 36}],
"buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

class Scenes : public Program {
 protected:
  Scenes() {
    write_file("corner.obj", kCorner);
    write_file("scene.gltf", kGltf);
  }

  /// The picture that a render makes; empty if it fails.
  std::string picture(const std::string& arguments) const {
    const Outcome outcome = run("render " + arguments + " -o p.png -q");
    EXPECT_EQ(outcome.exit_code, 0) << arguments << "\n" << outcome.err;
    return outcome.exit_code == 0 ? read_file("p.png") : "";
  }
};

TEST_F(Scenes, ASavedSceneGivesTheSameBytesAgain) {
  const char* const cases[] = {
      "corner.obj --size 40x30",
      "corner.obj --size 40x30 --camera 3,2,5 --projection plane --field-angle 33.3 --samples 2x2",
      "corner.obj --size 40x30 --light 4,6,3,1,0.5,0.25 --intensity 0.7 --sky '#88aaff,#332211' --ambient 0.1,0,0",
      "corner.obj --size 40x30 --up z --scale 0.37 --ground '#808080' --normals flat --falloff inverse-square",
      "corner.obj --size 40x30 --studio",
      "scene.gltf --size 40x30",
      "scene.gltf --size 40x30 --camera-name far --background 0.1,0.2,0.3",
      "scene.gltf --size 40x30 --file-camera off --file-lights off",
  };
  for (const char* const arguments : cases) {
    const std::string first = picture(std::string(arguments) + " --save-scene s.toml");
    EXPECT_EQ(picture("s.toml"), first) << arguments << "\n" << read_file("s.toml");
    // And what it saves itself is the same scene.
    EXPECT_EQ(picture("s.toml --save-scene t.toml"), first);
    EXPECT_EQ(picture("t.toml"), first) << read_file("t.toml");
  }
}

TEST_F(Scenes, SeveralViewsAndTurntablesAreSavedToo) {
  const std::string many = "--size 24x20 -q -o ";
  for (const std::string arguments :
       {"--camera 3,2,5 --camera 0,9,1 --look-at 0,0,0 --up y --up 1,0,0", "--turntable 3 --camera 3,2,5"}) {
    ASSERT_EQ(run("render corner.obj " + arguments + " --save-scene s.toml " + many + "a{n}.png").exit_code, 0);
    const Outcome again = run("render s.toml " + many + "b{n}.png");
    ASSERT_EQ(again.exit_code, 0) << again.err << read_file("s.toml");
    EXPECT_EQ(read_file("a0.png"), read_file("b0.png"));
    EXPECT_EQ(read_file("a1.png"), read_file("b1.png"));
    EXPECT_NE(read_file("a0.png"), read_file("a1.png"));
  }
  EXPECT_EQ(read_file("a2.png"), read_file("b2.png"));
}

TEST_F(Scenes, ASceneFileIsSaidInWords) {
  std::filesystem::create_directory(folder_ / "sub");
  write_file("sub/scene.toml", R"(
[settings]
size = "40x30"
samples = "2x2"
[[model]]
path = "corner.obj"
scale = 2
[[camera]]
position = [6, 4, 10]
look_at = [0, 0, 0]
field_angle = 40
[[light]]
position = [8, 12, 6]
)");
  expect_error(run("render sub/scene.toml -o p.png"), 1, "sub/scene.toml:6:8: \"corner.obj\": there is no such file");
  std::filesystem::copy_file(folder_ / "corner.obj", folder_ / "sub/corner.obj");
  const std::string flags =
      " --size 40x30 --samples 2x2 --camera 6,4,10 --look-at 0,0,0 --field-angle 40 --light 8,12,6";
  EXPECT_EQ(picture("sub/scene.toml"), picture("corner.obj --scale 2" + flags));
  EXPECT_NE(picture("sub/scene.toml"), picture("corner.obj" + flags));
  // Flags go before what the file says.
  EXPECT_EQ(picture("sub/scene.toml --field-angle 60"),
            picture("corner.obj --scale 2" + flags.substr(0, flags.find("--field-angle")) +
                    "--field-angle 60 --light 8,12,6"));
  EXPECT_NE(picture("sub/scene.toml --size 20x20"), picture("sub/scene.toml"));
}

TEST_F(Scenes, WhatIsWrongInASceneFileIsSaidWithItsPlace) {
  const std::string model = "[[model]]\npath = \"corner.obj\"\n";
  const std::pair<std::string, std::string> cases[] = {
      {"[settings]\nsampels = 4\n", "s.toml:4:1: unknown key \"sampels\" in [settings]; did you mean samples?"},
      {"[settings]\nsize = \"0x5\"\n", "s.toml:4:1: size: '0x5' is not a size: each side is 1 to 32768 pixels"},
      {"[settings]\noutput = \"/tmp/x.png\"\n", "s.toml:4:1: unknown key \"output\" in [settings]"},
      {"[settings]\nallow-outside = true\n", "s.toml:4:1: unknown key \"allow-outside\" in [settings]"},
      {"[settings]\nstudio = true\n", "s.toml:4:1: unknown key \"studio\" in [settings]"},
      {"[[camera]]\nsize = \"4x4\"\n", "s.toml:4:1: unknown key \"size\" in [[camera]]"},
      {"[[camera]]\nfield_angle = 400\n",
       "s.toml:4:1: field-angle: '400' is not an angle of more than 0 to 360 degrees"},
      {"[[light]\n", "s.toml:3:"},
  };
  for (const auto& [text, message] : cases) {
    write_file("s.toml", model + text);
    const Outcome outcome = run("render s.toml -o p.png");
    EXPECT_EQ(outcome.exit_code, 1) << text;
    EXPECT_EQ(outcome.err.substr(0, 9 + message.size()), "facemap: " + message) << text;
  }
  write_file("s.toml", "[[model]]\npath = \"../outside.obj\"\n");
  expect_error(
      run("render s.toml -o p.png"), 1,
      "s.toml:2:8: \"../outside.obj\": models outside the scene's folder are not opened unless that is allowed "
      "(--allow-outside)");
  EXPECT_EQ(run("render corner.obj -o p.png --save-scene corner.obj").exit_code, 2);
  EXPECT_EQ(read_file("corner.obj"), kCorner);
}

TEST_F(Scenes, TheFilesCamerasAndLightsAreUsed) {
  const std::string given = "scene.gltf --size 30x30 --file-camera off --file-lights off --projection plane ";
  const std::string camera = "--camera 0.2,0.3,3 --look-at 0.2,0.3,0 --field-angle 40.68000346929 ";
  const Outcome outcome = run("render scene.gltf --size 30x30 -o p.png");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "") << "nothing is made up";
  EXPECT_EQ(picture("scene.gltf --size 30x30"), picture("scene.gltf --size 30x30 --camera-name near"));
  EXPECT_EQ(picture("scene.gltf --size 30x30 --camera-name 1"), picture("scene.gltf --size 30x30 --camera-name far"));
  EXPECT_NE(picture("scene.gltf --size 30x30"), picture("scene.gltf --size 30x30 --camera-name far"));
  EXPECT_NE(picture("scene.gltf --size 30x30"), picture("scene.gltf --size 30x30 --file-lights off"));
  EXPECT_NE(picture("scene.gltf --size 30x30 --file-camera off"), picture("scene.gltf --size 30x30"));
  EXPECT_EQ(picture(given + camera), picture(given + camera + "--camera-name far")) << "a given camera goes before";
  ASSERT_EQ(run("render scene.gltf --size 9x9 --camera-name all -o all{n}.png -q").exit_code, 0);
  EXPECT_TRUE(exists("all0.png") && exists("all1.png") && !exists("all2.png"));
  expect_error(run("render scene.gltf --camera-name middle -o p.png"), 2,
               "--camera-name: 'middle' is none of the file's 2 cameras: near, far");
  expect_error(run("render corner.obj --camera-name 0 -o p.png"), 2, "--camera-name: there is no camera in corner.obj");
}

TEST_F(Scenes, UpIsTheWorldsUp) {
  // The same shape with z up: x, y, z of the one is x, -z, y of the other.
  std::string turned =
      "v 0 0 0\nv 2 0 0\nv 0 0 1\nv 0 -3 0\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
      "v 1 -1 0\nv 1.5 -1 0\nv 1 -1 0.75\nv 1 -1.5 0\nf 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8\n";
  write_file("turned.obj", turned);
  const std::string rest = " --size 32x32 --sky 0.4,0.5,0.6,0.2,0.1,0 --ground on";
  EXPECT_EQ(picture("turned.obj --up z" + rest), picture("corner.obj" + rest));
  EXPECT_EQ(picture("turned.obj --up 0,0,1" + rest), picture("corner.obj --up y" + rest));
  EXPECT_NE(picture("turned.obj" + rest), picture("corner.obj" + rest));
  // In a scene file each model has its own.
  write_file("s.toml", "[[model]]\npath = \"turned.obj\"\nup = \"z\"\n");
  EXPECT_EQ(picture("s.toml" + rest), picture("corner.obj" + rest));
  expect_error(run("render corner.obj --up w -o p.png"), 2,
               "--up: 'w' is not a direction: x, y, z, -x, -y, -z or three numbers x,y,z");
}

TEST_F(Scenes, ModelsComeFromStandardInputToo) {
  const std::string rest = " --size 24x20 -q -o ";
  ASSERT_EQ(run("render corner.obj" + rest + "a.png").exit_code, 0);
  EXPECT_EQ(run_shell("cat corner.obj | \"$facemap\" render -" + rest + "b.png").exit_code, 0);
  EXPECT_EQ(read_file("a.png"), read_file("b.png"));
  EXPECT_EQ(run_shell("\"$facemap\" render -" + rest + "c.png < corner.obj").exit_code, 0);
  EXPECT_EQ(read_file("a.png"), read_file("c.png"));
  ASSERT_EQ(run("render scene.gltf" + rest + "a.png").exit_code, 0);
  EXPECT_EQ(run_shell("cat scene.gltf | \"$facemap\" render -" + rest + "b.png").exit_code, 0);
  EXPECT_EQ(read_file("a.png"), read_file("b.png"));
  write_file("s.toml", "[[model]]\npath = \"scene.gltf\"\n");
  EXPECT_EQ(run_shell("cat s.toml | \"$facemap\" render -" + rest + "d.png").exit_code, 0);
  EXPECT_EQ(read_file("a.png"), read_file("d.png"));
  EXPECT_EQ(run_shell("cat corner.obj | \"$facemap\" - --size 24x20 -q").exit_code, 0);
  EXPECT_TRUE(exists("model.png"));
  expect_error(run_shell("\"$facemap\" render - -o p.png < /dev/null"), 1, "standard input: is empty");
  expect_error(run_shell("echo nonsense | \"$facemap\" render - -o p.png"), 1,
               "standard input: unknown format; known: OBJ, glTF, PLY, STL");
  expect_error(run_shell("cat corner.obj | \"$facemap\" render - -o p.png --save-scene s.toml -q"), 2,
               "--save-scene: a model from standard input has no file to name");
}

}  // namespace
