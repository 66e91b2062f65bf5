#include <facemap/image.h>

#include "cli/program.h"

namespace {

TEST_F(Program, SheetShowsModelsAndSaysWhichAreRefused) {
  write_file("bad.obj", "v 0 0\n");
  const Outcome outcome = run("sheet cube.obj bad.obj cube.obj -o sheet.png --size 32x32 --columns 2 -q");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("1  cube.obj\n2  bad.obj  refused: "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("3  cube.obj\n2 drawn, 0 of them flagged; 1 refused\n"), std::string::npos);
  const facemap::Picture24 sheet = facemap::read_png(folder_ / "sheet.png");
  EXPECT_EQ(sheet.width, 2 + 2 * (32 + 2));
  EXPECT_EQ(sheet.height, 2 + 2 * (32 + 2));
  for (int y = 16; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      const auto at = [&](int column, int row) {
        return static_cast<std::size_t>((2 + row) * sheet.width + 2 + column);
      };
      ASSERT_EQ(sheet.pixels[at(x, y)], sheet.pixels[at(x, y + 34)]) << "the same model, the same picture";
    }
  }
  EXPECT_EQ(run("sheet cube.obj bad.obj cube.obj -o - --size 32x32 --columns 2 -q").out, read_file("sheet.png"));
}

TEST_F(Program, SheetTakesTheModelsOfFoldersByName) {
  ASSERT_EQ(
      run_shell("mkdir -p models/b && cp cube.obj models/b/2.obj && cp cube.obj models/1.OBJ && echo > models/x.txt")
          .exit_code,
      0);
  const Outcome outcome = run("sheet models -o sheet.png --size 16x16 -q");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("1  models/1.OBJ\n2  models/b/2.obj\n2 drawn"), 0u) << outcome.out;
}

TEST_F(Program, SheetFlagsPicturesThatShowNothing) {
  write_file("black.mtl", "newmtl black\nKd 0 0 0\nKa 0 0 0\nillum 1\n");
  write_file("black.obj", "mtllib black.mtl\nusemtl black\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write_file("thin.obj", "v 0 0 0\nv 1 0 0\nv 0 1e-6 0\nf 1 2 3\n");
  const Outcome outcome = run("sheet black.obj thin.obj -o sheet.png --size 64x64 -q");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.out.find("black.obj  flagged: nearly black\n"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("thin.obj  flagged: empty\n"), std::string::npos) << outcome.out;
}

TEST_F(Program, SheetRefusesWhatItCannotDo) {
  expect_error(run("sheet -o sheet.png"), 2, "no model or folder is given");
  expect_error(run("sheet cube.obj"), 2, "no output file is given: add -o FILE, or -o - for standard output");
  expect_error(run_shell("mkdir -p none && \"$facemap\" sheet none -o sheet.png"), 1, "none: no model is there");
}

}  // namespace
