#include <facemap/error.h>
#include <facemap/scene.h>
#include <facemap/scene_file.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

using namespace facemap;
namespace fs = std::filesystem;

namespace {

class SceneFileTest : public testing::Test {
 protected:
  SceneFileTest() : folder_(fs::temp_directory_path() / ("facemap_scene_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_ / "parts");
    write("a.obj", "v 0 0 1\nv 1 0 1\nv 0 2 1\nf 1 2 3\n");
    write("parts/b.obj", "v 0 0 0\nv 1 0 0\nv 0 0 3\nf 1 3 2\n");
  }
  ~SceneFileTest() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

  SceneFile parse(const std::string& text) const { return parse_scene_file(text, "s.toml", folder_); }

  /// What is wrong with a text.
  std::string complaint(const std::string& text) const {
    try {
      parse(text);
    } catch (const LoadError& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_;
};

const std::string kModel = "[[model]]\npath = \"a.obj\"\n";

TEST_F(SceneFileTest, ReadsAllThatAFileMaySay) {
  const SceneFile scene = parse(R"(
[settings]
size = "80x60"
samples = 4
shadow_bias = 0.5
terminator-fix = false
sky = [1, 2, 3, 0.25, 0.5, 1]
aov = ["a", "b"]

[ground]
color = "#ff0000"
height = -1.5

[[model]]
path = "a.obj"
up = "z"
scale = 2
rotate = { axis = "y", degrees = 90 }
translate = [1, 2, 3]

[[model]]
path = "parts/b.obj"
matrix = [[1, 0, 0, 5], [0, 0, -1, 6], [0, 1, 0, 7], [0, 0, 0, 1]]

[[camera]]
name = "front"
position = [0.1, 2, 3]
look_at = [0, 0, 0]
field_angle = 40

[[light]]
kind = "spot"
position = [0, 9, 0]
look_at = [0, 0, 0]
inner_angle = 10
outer_angle = 20.5
color = [1, 0.5, 0.25]
intensity = 300
falloff = "inverse-square"
range = 50
)");
  ASSERT_EQ(scene.models.size(), 2u);
  EXPECT_EQ(scene.models[0].path, folder_ / "a.obj");
  EXPECT_EQ(scene.models[0].up, Vector(0, 0, 1));
  EXPECT_EQ(scene.models[0].transform.point({0, 0, 1}), DVector(3, 2, 3)) << "scaled, then turned, then moved";
  EXPECT_EQ(scene.models[1].transform.point({1, 2, 3}), DVector(6, 3, 9));
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.cameras[0].name, "front");
  EXPECT_EQ(scene.cameras[0].position, Vector(0.1f, 2, 3));
  EXPECT_FALSE(scene.cameras[0].up);
  ASSERT_EQ(scene.cameras[0].settings.size(), 1u);
  EXPECT_EQ(scene.cameras[0].settings[0].name, "field-angle");
  EXPECT_EQ(scene.cameras[0].settings[0].line, 29);
  EXPECT_EQ(scene.cameras[0].settings[0].column, 1);
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].direction, Vector(0, -9, 0));
  EXPECT_EQ(scene.lights[0].outer_angle, 20.5 * (3.14159265358979323846 / 180));
  EXPECT_TRUE(scene.lights[0].has_falloff);
  ASSERT_TRUE(scene.ground);
  EXPECT_EQ(scene.ground->color.r, 1);
  EXPECT_EQ(scene.ground->height, -1.5);
  std::string settings;
  for (const SceneSetting& setting : scene.settings) {
    settings += setting.name + ":";
    for (const std::string& value : setting.values) settings += " " + value;
    settings += "\n";
  }
  EXPECT_EQ(settings,
            "aov: a b\nsamples: 4\nshadow-bias: 0.5\nsize: 80x60\nsky: 1,2,3,0.25,0.5,1\nterminator-fix: off\n");
}

TEST_F(SceneFileTest, SaysWhereAndWhatIsWrong) {
  const std::pair<std::string, std::string> cases[] = {
      {"[[model]]\npath = a.obj", "s.toml:2:8: "},
      {"[settings]\n", "s.toml:1:1: no model: a scene needs a table [[model]] with a path"},
      {kModel + "scal = 2",
       "s.toml:3:1: unknown key \"scal\" in [[model]]; did you mean scale? (known: path, up, scale, rotate, translate, "
       "matrix)"},
      {kModel + "[[lamp]]\n",
       "s.toml:3:3: unknown key \"lamp\" in a scene (known: model, camera, light, ground, settings)"},
      {"[[model]]\nup = \"y\"", "s.toml:1:1: [[model]] has no path"},
      {"[[model]]\npath = \"c.obj\"", "s.toml:2:8: \"c.obj\": there is no such file"},
      {"[[model]]\npath = \"../c.obj\"",
       "s.toml:2:8: \"../c.obj\": models outside the scene's folder are not opened unless that is allowed "
       "(--allow-outside)"},
      {"[[model]]\npath = \"/etc/passwd\"", "s.toml:2:8: \"/etc/passwd\": models outside"},
      {kModel + "up = \"w\"", "s.toml:3:6: is not x, y, z, -x, -y, -z or an array of 3 numbers"},
      {kModel + "scale = 0", "s.toml:3:9: a scale of 0 flattens the model"},
      {kModel + "scale = [1, 2]", "s.toml:3:9: is an array of 2, not an array of 3 numbers"},
      {kModel + "translate = 5", "s.toml:3:13: is a number, not an array of 3 numbers"},
      {kModel + "rotate = { axis = [0, 0, 0], degrees = 4 }", "s.toml:3:19: has no direction"},
      {kModel + "rotate = { axis = \"y\" }", "s.toml:3:10: rotate has no degrees"},
      {kModel + "rotate = { axis = \"y\", degrees = inf }", "s.toml:3:34: is not a finite number"},
      {kModel + "matrix = [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,2]]", "s.toml:3:41: the last row is not 0, 0, 0, 1"},
      {kModel + "scale = 2\nmatrix = [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]",
       "s.toml:4:10: a matrix is all of the transform"},
      {kModel + "[[light]]\nposition = [1, 2]", "s.toml:4:12: is an array of 2, not an array of 3 numbers"},
      {kModel + "[[light]]\nkind = \"sopt\"",
       "s.toml:4:8: \"sopt\" is not known; did you mean spot? (known: point, spot, directional)"},
      {kModel + "[[light]]\nkind = \"spot\"\nposition = [1, 2, 3]", "s.toml:3:1: [[light]] has no direction"},
      {kModel + "[[light]]\nposition = [1e39, 2, 3]", "s.toml:4:13: is too large for a float"},
      {kModel + "[[light]]\nposition = [1, 2, 3]\ncolor = \"red\"", "s.toml:5:9: is not a colour"},
      {kModel + "[[light]]\nposition = [1, 2, 3]\nrange = -1", "s.toml:5:9: is not above 0"},
      {kModel + "[[light]]\nkind = \"spot\"\nposition = [1,2,3]\ndirection = \"-y\"\ninner_angle = 60",
       "s.toml:7:15: is wider than outer_angle"},
      {kModel + "[settings]\nsize = 1979-05-27", "s.toml:4:8: is a date or time, not a text, a number"},
      {kModel + "[settings]\nsize = []", "s.toml:4:8: is an empty array"},
      {"model = 3", "s.toml:1:9: model is a number, not a table [[model]]"},
      {"ground = 3\n" + kModel, "s.toml:1:10: is not a table [ground]"},
  };
  for (const auto& [text, wanted] : cases) {
    const std::string said = complaint(text);
    EXPECT_EQ(said.substr(0, wanted.size()), wanted) << text << "\n" << said;
  }
}

TEST_F(SceneFileTest, DeepFilesAreRefusedBeforeTheStackEnds) {
  std::string keys = "a";
  for (int i = 0; i < 300; ++i) keys += ".a";
  EXPECT_EQ(complaint("\n" + keys + " = 1"), "s.toml:2: more than 200 dots in a line");
  EXPECT_NE(complaint("a = " + std::string(100, '[') + std::string(100, ']')), "");
}

TEST_F(SceneFileTest, WhatIsWrittenReadsBackAsTheSame) {
  SceneFile scene;
  scene.models = {
      {folder_ / "a.obj", Vector(0, 0, 1), Affine::scaling(DVector(0.1))},
      {folder_ / "parts/b.obj", std::nullopt,
       Affine::translation({0.1, 1e-9, 3}) * Affine::rotation({1, 2, 3}, 17) * Affine::scaling({1, -2, 3})}};
  SceneCamera camera;
  camera.name = "say \"hi\"\n\\";
  camera.position = Vector(1.0f / 3, 1e-30f, -12345.678f);
  camera.look_at = Vector(0.1f, 0.2f, 0.3f);
  camera.settings = {{"field-angle", {"33.3"}, 0, 0}};
  scene.cameras = {camera};
  Light light;
  light.kind = Light::Kind::Spot;
  light.position = {0.7f, 1, 2};
  light.direction = {0.1f, -0.9f, 0.3f};
  light.inner_angle = 12.5 * (3.14159265358979323846 / 180);
  light.outer_angle = 33.25 * (3.14159265358979323846 / 180);
  light.color = {0.1f, 0.2f, 0.3f};
  light.range = 1.0 / 3;
  scene.lights = {light};
  scene.ground = SceneGround{{0.1f, 0.2f, 0.3f}, 1.0 / 3, std::nullopt};
  scene.settings = {{"size", {"40x30"}, 0, 0}, {"tags", {"a", "b\t"}, 0, 0}};

  const fs::path file = folder_ / "saved.toml";
  save_scene_file(scene, file);
  const SceneFile read = load_scene_file(file);
  EXPECT_EQ(read.models, scene.models);
  EXPECT_EQ(read.cameras[0].name, camera.name);
  EXPECT_EQ(read.cameras[0].position, camera.position);
  EXPECT_EQ(read.cameras[0].settings[0].values, camera.settings[0].values);
  EXPECT_EQ(read.lights[0].position, light.position);
  EXPECT_EQ(read.lights[0].direction, light.direction);
  EXPECT_EQ(read.lights[0].inner_angle, light.inner_angle);
  EXPECT_EQ(read.lights[0].outer_angle, light.outer_angle);
  EXPECT_EQ(read.lights[0].range, light.range);
  EXPECT_EQ(read.ground->height, scene.ground->height);
  EXPECT_EQ(read.settings[1].values, scene.settings[1].values);
  EXPECT_EQ(scene_file_text(read, folder_), scene_file_text(scene, folder_));
}

TEST_F(SceneFileTest, SettingsAreInTheSameOrderHoweverTheyAreSpelt) {
  const std::string text = scene_file_text(parse(kModel + "[settings]\nab-c = 1\nab_ = 2\nab-d = 3\n"), folder_);
  EXPECT_EQ(scene_file_text(parse(text), folder_), text);
}

TEST_F(SceneFileTest, LoadsModelsEachAtItsPlace) {
  const SceneFile scene = parse(kModel + "[[model]]\npath = \"parts/b.obj\"\nup = \"z\"\ntranslate = [0, 1, 0]\n");
  const Model model = load_models(scene.models, {0, 1, 0});
  ASSERT_EQ(model.mesh.face_count(), 2u);
  EXPECT_EQ(model.mesh.vertex(0, 2), Vector(0, 2, 1));
  EXPECT_EQ(model.mesh.vertex(1, 1), Vector(0, 4, 0)) << "z became y";
  ModelLimits limits;
  limits.max_faces = 1;
  EXPECT_THROW(load_models(scene.models, {0, 1, 0}, limits), LoadError);
}

TEST_F(SceneFileTest, TheGroundLiesBelowTheModels) {
  const Model models = load_models(parse(kModel).models, {0, 1, 0});
  for (const Vector up : {Vector(0, 1, 0), Vector(0, 0, 1), Vector(1, 2, -3), Vector(0, -1, 0)}) {
    const Model ground = make_ground({}, models, up);
    const DVector axis = glm::normalize(DVector(up));
    double highest = -INFINITY, lowest = INFINITY;
    for (const Vector& v : ground.mesh.positions) highest = std::max(highest, glm::dot(axis, DVector(v)));
    for (const Vector& v : models.mesh.positions) lowest = std::min(lowest, glm::dot(axis, DVector(v)));
    EXPECT_LT(highest, lowest);
    EXPECT_GT(highest, lowest - 0.01);
    const Mesh& mesh = ground.mesh;
    const DVector front =
        glm::cross(DVector(mesh.vertex(0, 1) - mesh.vertex(0, 0)), DVector(mesh.vertex(0, 2) - mesh.vertex(0, 0)));
    EXPECT_GT(glm::dot(front, axis), 0) << "it faces up";
  }
  SceneGround wanted;
  wanted.height = -2;
  wanted.radius = 7;
  const Model ground = make_ground(wanted, models, {0, 1, 0});
  EXPECT_EQ(ground.mesh.positions[1].y, -2);
  EXPECT_FLOAT_EQ(static_cast<float>(bounding_ball(ground.mesh).radius), 7);
  EXPECT_THROW(make_ground({}, models, Vector(0)), Error);
}

TEST_F(SceneFileTest, KnowsASceneFromAModel) {
  EXPECT_TRUE(is_scene_file("", ".toml"));
  EXPECT_TRUE(is_scene_file("# a scene\n\n[[model]]\npath = 1"));
  EXPECT_FALSE(is_scene_file("# an OBJ file\nv 0 0 0\n"));
  EXPECT_FALSE(is_scene_file("[[model]]", ".obj"));
  EXPECT_FALSE(is_scene_file("{\"asset\": {}}"));
}

}  // namespace
