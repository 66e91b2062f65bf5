#include "cli/program.h"

namespace {

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

/// A textured OBJ file and a scene of an STL file. No picture may take the place of what they are made of.
class InputsStay : public Program {
 protected:
  InputsStay() {
    write_file("leaf.obj",
               std::string("mtllib leaf.mtl\nusemtl leaf\n") + kTriangle + "vt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
    write_file("leaf.mtl", "newmtl leaf\nKd 1 1 1\nmap_Kd leaf.png\n");
    write_file("leaf.png", "no picture, and still a file that the model names");
    write_file("part.stl",
               "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
               "endfacet\nendsolid s\n");
    write_file("scene.toml", "[[model]]\npath = \"part.stl\"\n");
  }

  /// Runs what must be refused for the sake of `file`.
  void expect_stays(const std::string& arguments, const std::string& file, const std::string& reason) {
    const std::string before = read_file(file);
    expect_error(run("render " + arguments + " --size 8x8 -q"), 2, file + ": the output would replace " + reason);
    EXPECT_EQ(read_file(file), before) << arguments;
  }
};

TEST_F(InputsStay, TexturesAndLibrariesAreNotReplaced) {
  const char* const needed = "a file that the model needs";
  expect_stays("leaf.obj -o leaf.png", "leaf.png", needed);
  expect_stays("leaf.obj -o new.png --aov depth=leaf.png", "leaf.png", needed);
  expect_stays("leaf.obj -o new.png --save-scene leaf.png", "leaf.png", needed);
  expect_stays("leaf.obj -o leaf.mtl --format png", "leaf.mtl", "a model's file");
  EXPECT_FALSE(exists("new.png"));
  std::filesystem::create_symlink("leaf.png", folder_ / "link.png");
  expect_stays("leaf.obj -o link.png", "link.png", needed);
}

TEST_F(InputsStay, MapsAndSheetsReplaceNoTexturesEither) {
  const std::string before = read_file("leaf.png");
  const std::string message = "leaf.png: the output would replace a file that the model needs";
  expect_error(run("map leaf.obj --at 0,0,5 --size 8x8 -q -o leaf.png"), 2, message);
  expect_error(run("sheet leaf.obj --size 8x8 -q -o leaf.png"), 2, message);
  EXPECT_EQ(read_file("leaf.png"), before);
}

TEST_F(InputsStay, ModelsOfSceneFilesAreNotReplaced) {
  expect_stays("scene.toml -o new.png --save-scene part.stl", "part.stl", "a model's file");
  expect_stays("scene.toml -o part.stl --format png", "part.stl", "a model's file");
  std::filesystem::copy_file(folder_ / "part.stl", folder_ / "part.data");
  write_file("scene.toml", "[[model]]\npath = \"part.data\"\n");
  expect_stays("scene.toml -o part.data --format png", "part.data", "a file that the model needs");
  EXPECT_EQ(run("render scene.toml -o new.data --format png --size 8x8 -q").exit_code, 0);
}

TEST_F(InputsStay, TheSavedSceneIsAFileOfItsOwn) {
  expect_error(run("render cube.obj -o o.png --save-scene o.png"), 2, "o.png: two outputs name this file");
  expect_error(run("render cube.obj -o o.png --aov id=i.npy --save-scene ./i.npy"), 2,
               "./i.npy: two outputs name this file");
  expect_error(run("render cube.obj -o - --save-scene -"), 2, "--save-scene: standard output takes the picture alone");
  expect_error(run("render cube.obj -o o.png --stats json --save-scene -"), 2,
               "--save-scene - and --stats would both write to standard output");
  expect_error(run("render - -o o.png --save-scene q.toml < cube.obj"), 2,
               "--save-scene: a model from standard input has no file to name");
  EXPECT_EQ(run_shell("cp cube.obj \"$(printf 'bad\\377.obj')\"").exit_code, 0);
  const Outcome outcome =
      run_shell("\"$facemap\" render \"$(printf 'bad\\377.obj')\" -o o.png --size 8x8 -q --save-scene q.toml");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("a scene file can name only files in UTF-8"), std::string::npos) << outcome.err;
  EXPECT_FALSE(exists("o.png") || exists("q.toml"));
}

}  // namespace
