#include "scene/gltf_nodes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "scene/gltf.h"
#include "support/gltf_text.h"

namespace facemap {
namespace {

using Cause = LoadError::Cause;

Model read(const std::string& nodes) {
  return read_gltf(triangle_text().text(kTriangleMesh + "," + nodes), "t.gltf", ".");
}

void expect_refused(const std::string& nodes, Cause cause, const std::string& part) {
  try {
    read(nodes);
    ADD_FAILURE() << "was read: " << nodes;
  } catch (const LoadError& error) {
    EXPECT_EQ(error.cause(), cause) << error.what();
    EXPECT_NE(error.reason().find(part), std::string::npos) << error.what();
  }
}

TEST(GltfNodes, ScaleThenTurnThenMove) {
  // A quarter turn about z, from x to y; twice as long a quaternion means the same.
  for (const char* const rotation : {"[0,0,0.5,0.5]", "[0,0,1,1]", "[0,0,1e-200,1e-200]"}) {
    const Mesh mesh = read("\"nodes\":[{\"mesh\":0,\"translation\":[10,20,30],\"scale\":[2,3,4],\"rotation\":" +
                           std::string(rotation) + "}]")
                          .mesh;
    EXPECT_EQ(mesh.positions, (std::vector<Vector>{{10, 20, 30}, {10, 22, 30}, {7, 20, 30}})) << rotation;
  }
}

TEST(GltfNodes, PassTheirTransformsToTheirChildren) {
  const Mesh mesh = read(
                        "\"nodes\":[{\"children\":[1],\"translation\":[1,0,0]},{\"children\":[2],\"scale\":[2,2,2]},"
                        "{\"mesh\":0,\"matrix\":[0,1,0,0,-1,0,0,0,0,0,1,0,3,0,0,1]}]")
                        .mesh;
  EXPECT_EQ(mesh.positions, (std::vector<Vector>{{7, 0, 0}, {7, 2, 0}, {5, 0, 0}}));
  EXPECT_EQ(mesh.triangles[0], (Corners{0, 1, 2}));
}

TEST(GltfNodes, TurnTheFacesOfMirroredMeshes) {
  const Mesh mesh = read("\"nodes\":[{\"mesh\":0,\"scale\":[-1,1,1]},{\"mesh\":0,\"scale\":[-1,-1,1]}]").mesh;
  EXPECT_EQ(mesh.triangles, (std::vector<Corners>{{0, 2, 1}, {3, 4, 5}}));
}

TEST(GltfNodes, TurnNormalsSoThatTheyStayNormal) {
  GltfText gltf = triangle_text();
  gltf.accessor(bytes_of<float>({1, 1, 0, 1, 1, 0, 1, 1, 0}), kFloat32, "VEC3", 3);
  const Mesh mesh = read_gltf(gltf.text("\"nodes\":[{\"mesh\":0,\"scale\":[-1,2,1]}],\"meshes\":[{\"primitives\":[{"
                                        "\"attributes\":{\"POSITION\":0,\"NORMAL\":1}}]}]"),
                              "t.gltf", ".")
                        .mesh;
  // The normal of the plane -x + y / 2 = const, in which the images of (1, -1, 0) and (0, 0, 1) lie.
  EXPECT_FLOAT_EQ(mesh.normals[0].x, -std::sqrt(0.8f));
  EXPECT_FLOAT_EQ(mesh.normals[0].y, std::sqrt(0.2f));
  EXPECT_EQ(mesh.normals[0].z, 0);
}

TEST(GltfNodes, BelongToOneScene) {
  const std::string nodes = "\"nodes\":[{\"mesh\":0,\"name\":\"A\"},{\"mesh\":0,\"name\":\"B\"}]";
  const std::string scenes = ",\"scenes\":[{\"nodes\":[0]},{\"nodes\":[1]}]";
  EXPECT_EQ(read(nodes).objects, (std::vector<std::string>{"A", "B"}));
  EXPECT_EQ(read(nodes + scenes).objects, std::vector<std::string>{"A"});
  EXPECT_EQ(read(nodes + scenes + ",\"scene\":1").objects, std::vector<std::string>{"B"});
  expect_refused(nodes + scenes + ",\"scene\":2", Cause::BadIndex, "scene: names scenes[2] of 2");
  expect_refused(nodes + ",\"scenes\":[{}]", Cause::NoFaces, "no faces");
}

TEST(GltfNodes, FormTrees) {
  expect_refused("\"nodes\":[{\"children\":[1]},{\"children\":[0]}]", Cause::BadIndex, "nodes[0]: is its own ancestor");
  expect_refused("\"nodes\":[{\"children\":[0]}]", Cause::BadIndex, "nodes[0]: is its own ancestor");
  expect_refused("\"nodes\":[{\"children\":[2]},{\"children\":[2]},{}]", Cause::BadIndex, "node 2 has two parents");
  expect_refused("\"nodes\":[{\"children\":[1,1]},{}]", Cause::BadIndex, "node 1 has two parents");
  expect_refused("\"nodes\":[{\"children\":[5]}]", Cause::BadIndex, "nodes[0].children[0]: names nodes[5] of 1");
  expect_refused("\"nodes\":[{\"children\":[1]},{}],\"scenes\":[{\"nodes\":[1]}]", Cause::BadIndex, "is not a root");
  expect_refused("\"nodes\":[{\"mesh\":0}],\"scenes\":[{\"nodes\":[0,0]}]", Cause::BadIndex, "is named twice");
}

TEST(GltfNodes, MayBeAsDeepAsAFileGoes) {
  constexpr int kCount = 100000;
  std::string nodes = "\"nodes\":[{\"mesh\":0}";
  for (int i = 1; i < kCount; ++i) nodes += ",{\"children\":[" + std::to_string(i - 1) + "]}";
  EXPECT_EQ(read(nodes + "]").mesh.face_count(), 1u);
}

TEST(GltfNodes, RefuseProjections) {
  expect_refused("\"nodes\":[{\"mesh\":0,\"matrix\":[1,0,0,1,0,1,0,0,0,0,1,0,0,0,0,1]}]", Cause::BadValue,
                 "nodes[0].matrix: its last row");
  expect_refused("\"nodes\":[{\"mesh\":0,\"matrix\":[1,2]}]", Cause::BadValue, "is not an array of 16 numbers");
  expect_refused("\"nodes\":[{\"mesh\":0,\"scale\":[1,2,\"x\"]}]", Cause::BadValue,
                 "nodes[0].scale[2]: is not a number");
}

TEST(GltfNodes, MoveWhatHangsOnThemAsJoints) {
  GltfText gltf = triangle_text();
  gltf.accessor(bytes_of<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}), kUint8, "VEC4", 3);
  gltf.accessor(bytes_of<float>({1, 0, 0, 0, 2, 0, 0, 0, 0.25f, 0.75f, 0, 0}), kFloat32, "VEC4", 3);
  gltf.accessor(bytes_of<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 7, 1,    // moves by z = 7
                                 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}),  // moves nothing
                kFloat32, "MAT4", 2);
  const auto read_skin = [&](const std::string& joints) {
    return read_gltf(
        gltf.text("\"nodes\":[{\"mesh\":0,\"skin\":0,\"translation\":[99,99,99]},{\"translation\":[0,0,1]},"
                  "{\"scale\":[-4,4,4]}],\"skins\":[{\"joints\":" +
                  joints +
                  ",\"inverseBindMatrices\":3}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,"
                  "\"JOINTS_0\":1,\"WEIGHTS_0\":2}}]}]"),
        "t.gltf", ".");
  };
  const Mesh mesh = read_skin("[1,2]").mesh;
  // The last is a quarter of (0, 1, 8) and three quarters of (0, 4, 0).
  EXPECT_EQ(mesh.positions, (std::vector<Vector>{{0, 0, 8}, {-4, 0, 0}, {0, 3.25f, 2}}));
  EXPECT_EQ(mesh.triangles[0], (Corners{0, 1, 2}));
  EXPECT_EQ(read_skin("[2,1]").mesh.triangles[0], (Corners{0, 2, 1}));  // mirrored
  EXPECT_THROW(read_skin("[1]"), LoadError);                            // no joint 1
  EXPECT_THROW(read_skin("[1,7]"), LoadError);                          // no node 7
  EXPECT_THROW(read_skin("[1,2,0]"), LoadError);                        // two matrices
}

TEST(GltfNodes, CarryLights) {
  const Model model = read(
      "\"nodes\":[{\"mesh\":0},{\"translation\":[1,2,3],\"scale\":[7,7,7],\"rotation\":[0,1,0,1],"
      "\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}},{\"extensions\":{\"KHR_lights_punctual\":{\"light\":1}}}"
      ","
      "{\"extensions\":{\"KHR_lights_punctual\":{\"light\":2}}},{\"extensions\":{\"KHR_lights_punctual\":{\"light\":3}}"
      "}],"
      "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"spot\",\"color\":[1,0.5,0.25],\"intensity\":8,"
      "\"range\":20,\"spot\":{\"innerConeAngle\":0.25,\"outerConeAngle\":0.5}},{\"type\":\"point\"},"
      "{\"type\":\"directional\",\"range\":5},{\"type\":\"spherical\"}]}}");
  ASSERT_EQ(model.lights.size(), 3u);
  const Light& spot = model.lights[0];
  EXPECT_EQ(spot.kind, Light::Kind::Spot);
  EXPECT_EQ(spot.position, Vector(1, 2, 3));
  EXPECT_EQ(spot.direction, Vector(-1, 0, 0));
  EXPECT_EQ(spot.color, (Color{1, 0.5f, 0.25f}));
  EXPECT_EQ(spot.intensity, 8);
  EXPECT_EQ(spot.inner_angle, 0.25);
  EXPECT_EQ(spot.outer_angle, 0.5);
  EXPECT_EQ(spot.range, 20);
  EXPECT_TRUE(spot.has_falloff);
  EXPECT_EQ(model.lights[1].kind, Light::Kind::Point);
  EXPECT_TRUE(model.lights[1].has_falloff);
  EXPECT_EQ(model.lights[2].kind, Light::Kind::Directional);
  EXPECT_EQ(model.lights[2].direction, Vector(0, 0, -1));
  EXPECT_FALSE(model.lights[2].has_falloff);
  EXPECT_EQ(model.lights[2].range, Light().range);
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_NE(model.warnings[0].find("lights[3]"), std::string::npos) << model.warnings[0];
}

TEST(GltfNodes, CarryCameras) {
  const Model model = read(
      "\"nodes\":[{\"mesh\":0},{\"camera\":0,\"translation\":[1,2,3]},{\"camera\":1,\"name\":\"top\",\"rotation\":[-1,"
      "0,0,1]}],"
      "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.75,\"znear\":0.1},\"name\":\"front\"},"
      "{\"type\":\"orthographic\",\"orthographic\":{\"xmag\":2,\"ymag\":3,\"znear\":0,\"zfar\":9}}]");
  ASSERT_EQ(model.cameras.size(), 2u);
  EXPECT_EQ(model.cameras[0].name, "front");
  EXPECT_EQ(model.cameras[0].position, Vector(1, 2, 3));
  EXPECT_EQ(model.cameras[0].look_at, Vector(1, 2, 0));
  EXPECT_EQ(model.cameras[0].up, Vector(0, 1, 0));
  EXPECT_EQ(model.cameras[0].field_angle, 0.75);
  EXPECT_FALSE(model.cameras[0].is_parallel);
  EXPECT_EQ(model.cameras[1].name, "top");
  EXPECT_EQ(model.cameras[1].look_at, Vector(0, -1, 0));
  EXPECT_EQ(model.cameras[1].up, Vector(0, 0, -1));
  EXPECT_EQ(model.cameras[1].height, 6);
  EXPECT_TRUE(model.cameras[1].is_parallel);
  EXPECT_TRUE(model.warnings.empty());
}

}  // namespace
}  // namespace facemap
