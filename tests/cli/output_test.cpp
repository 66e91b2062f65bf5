#include <facemap/compare.h>
#include <facemap/image.h>

#include "cli/program.h"

namespace {

using facemap::PictureChannels;

constexpr const char* kView = " --camera 3,2,5 --look-at 0,0,0 --light 4,6,3 --size 48x32 -q ";

std::string render(const std::string& flags) { return "render cube.obj " + flags + kView; }

TEST_F(Program, EveryFormatHoldsThePicture) {
  const std::pair<const char*, std::string> cases[] = {{"a.png", "\x89PNG"},           {"a.jpg", "\xff\xd8\xff"},
                                                       {"a.JPEG", "\xff\xd8\xff"},     {"a.exr", "\x76\x2f\x31\x01"},
                                                       {"a.pfm", "PF\n48 32\n-1.0\n"}, {"a.npy", "\x93NUMPY"}};
  for (const auto& [name, magic] : cases) {
    SCOPED_TRACE(name);
    const Outcome outcome = run(render(std::string("-o ") + name));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string bytes = read_file(name);
    EXPECT_EQ(bytes.substr(0, magic.size()), magic);
    EXPECT_EQ(run(render(std::string("-o ") + name)).exit_code, 0);
    EXPECT_EQ(read_file(name), bytes) << "no date, no path: the same bytes each time";
  }
  EXPECT_EQ(read_file("a.jpg"), read_file("a.JPEG"));
  EXPECT_NE(read_file("a.npy").find("'descr': '<f4', 'fortran_order': False, 'shape': (32, 48, 3)"), std::string::npos);
  EXPECT_EQ(run("compare a.jpg a.png --mean-threshold 4").exit_code, 0);
  EXPECT_EQ(run("compare a.exr a.pfm --threshold 0.0005 --max-different 0").exit_code, 0) << "half has 11 bits";
}

TEST_F(Program, BitsAndQualityAreOfThePicture) {
  ASSERT_EQ(run(render("-o 8.png")).exit_code, 0);
  ASSERT_EQ(run(render("-o 16.png --bits 16")).exit_code, 0);
  EXPECT_EQ(read_file("8.png")[24], 8);
  EXPECT_EQ(read_file("16.png")[24], 16);
  EXPECT_EQ(run("compare 8.png 16.png --threshold 0.5 --max-different 0").exit_code, 0)
      << "rounded to the nearest level";
  ASSERT_EQ(run(render("-o 32.exr --bits 32")).exit_code, 0);
  ASSERT_EQ(run(render("-o a.pfm")).exit_code, 0);
  EXPECT_EQ(run("compare 32.exr a.pfm --threshold 0").exit_code, 0) << "float32 both";
  ASSERT_EQ(run(render("-o good.jpg --quality 98")).exit_code, 0);
  ASSERT_EQ(run(render("-o bad.jpg --quality 20")).exit_code, 0);
  EXPECT_GT(read_file("good.jpg").size(), read_file("bad.jpg").size());
}

TEST_F(Program, StandardOutputTakesEveryFormat) {
  const std::pair<const char*, const char*> cases[] = {{"", "a.png"},
                                                       {"--format png --bits 16", "b.png"},
                                                       {"--format jpeg", "a.jpg"},
                                                       {"--format exr", "a.exr"},
                                                       {"--format pfm", "a.pfm"},
                                                       {"--format npy", "a.npy"}};
  for (const auto& [flags, name] : cases) {
    SCOPED_TRACE(flags);
    const std::string bits = std::string(name) == "b.png" ? " --bits 16" : "";
    ASSERT_EQ(run(render("-o " + std::string(name) + bits)).exit_code, 0);
    const Outcome piped = run(render("-o - " + std::string(flags)));
    EXPECT_EQ(piped.exit_code, 0);
    EXPECT_TRUE(piped.out == read_file(name)) << piped.err;
  }
  ASSERT_EQ(run(render("-o picture --format exr")).exit_code, 0);
  EXPECT_EQ(read_file("picture"), read_file("a.exr"));
}

TEST_F(Program, PlanesAreLayersOfAnExrPicture) {
  ASSERT_EQ(run(render("-o a.exr --aov z --aov normal --aov id --aov depth=depth.exr")).exit_code, 0);
  EXPECT_EQ(files(), "a.exr depth.exr ");
  std::string names;
  for (const auto& channel : facemap::read_picture(folder_ / "a.exr").channels) names += channel.name + " ";
  EXPECT_EQ(names, "B G N.X N.Y N.Z R Z face.id ");
  const PictureChannels depth = facemap::read_picture(folder_ / "depth.exr");
  ASSERT_EQ(depth.channels.size(), 1u);
  EXPECT_EQ(depth.channels[0].name, "range.Z");
  expect_error(run(render("-o a.exr --aov z --aov z")), 2, "--aov: z is given more than once");
  EXPECT_EQ(run(render("-o a.exr --aov z --aov z=z.npy")).exit_code, 0) << "a layer and a file";
}

TEST_F(Program, EveryPlaneIsWritten) {
  const std::string planes[] = {"id",     "depth", "z",      "position", "normal", "face-normal",
                                "albedo", "uv",    "object", "material", "lights", "shadows"};
  for (const std::string& plane : planes) {
    SCOPED_TRACE(plane);
    const Outcome outcome = run(render("-o a.png --aov " + plane + "=p.npy"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(read_file("p.npy").substr(1, 5), "NUMPY");
    ASSERT_EQ(run(render("-o a.exr --aov " + plane + "=p.png")).exit_code, 0);
    EXPECT_EQ(facemap::read_png(folder_ / "p.png").width, 48);
    ASSERT_EQ(run(render("-o a.exr --aov " + plane + " --aov " + plane + "=p.exr")).exit_code, 0);
    EXPECT_EQ(run(render("-o a.jpg --aov " + plane + "=p.jpg")).exit_code, 0);
  }
}

TEST_F(Program, InfoNamesObjectsAndMaterials) {
  write_file("two.obj",
             "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\no left\nusemtl red\nf 1 2 3\no right\nf 2 3 4\n");
  write_file("two.mtl", "newmtl blue\nKd 0 0 1\nnewmtl red\nKd 1 0 0\n");
  const std::string plain = run("info two.obj").out, named = run("info two.obj --names").out;
  EXPECT_EQ(named, plain +
                       "  object 0              left\n  object 1              right\n"
                       "  material 0            blue\n  material 1            red\n");
}

TEST_F(Program, NamesHoldTheModelAndTheNumber) {
  ASSERT_EQ(run(render("-o {model}_{n:03}.png --aov z={model}-{n}.npy --turntable 2")).exit_code, 0);
  EXPECT_EQ(files(), "cube-0.npy cube-1.npy cube_000.png cube_001.png ");
  ASSERT_EQ(run(render("-o {model}.png")).exit_code, 0);
  EXPECT_TRUE(exists("cube.png"));
  EXPECT_EQ(run(render("-o '{1}{}{.png'")).exit_code, 0);
  EXPECT_TRUE(exists("{1}{}{.png")) << "braces are not always ours";
  expect_error(run(render("-o {frame}.png")), 2, "{frame}.png: {frame} stands for nothing; {n}, {n:04} and {model} do");
  expect_error(run(render("-o {n:4}.png")), 2, "{n:4}.png: {n:4} stands for nothing; {n}, {n:04} and {model} do");
  expect_error(run(render("-o {model}.png --turntable 3")), 2,
               "{model}.png: the names of 3 pictures need {n}, the picture's number, such as {model}_{n}.png");
}

TEST_F(Program, FramesDivideTheWork) {
  ASSERT_EQ(run(render("-o all{n}.png --turntable 12")).exit_code, 0);
  ASSERT_EQ(run(render("-o part{n}.png --turntable 12 --frames 0..4")).exit_code, 0);
  ASSERT_EQ(run(render("-o part{n}.png --turntable 12 --frames 5-10")).exit_code, 0);
  ASSERT_EQ(run(render("-o last.png --turntable 12 --frames 11")).exit_code, 0) << "one picture needs no number";
  for (const char* number : {"00", "04", "05", "10"}) {
    EXPECT_EQ(read_file("part" + std::string(number) + ".png"), read_file("all" + std::string(number) + ".png"));
  }
  EXPECT_EQ(read_file("last.png"), read_file("all11.png"));
  EXPECT_FALSE(exists("part11.png"));
  EXPECT_TRUE(run(render("-o - --turntable 12 --frames 3")).out == read_file("all03.png"));
  ASSERT_EQ(run("render cube.obj -o c{n}.png --camera 1,2,9 --camera 3,2,5 --look-at 0,0,0 --light 4,6,3 --size 48x32 "
                "--frames 1")
                .err,
            "");
  ASSERT_EQ(run(render("-o d.png")).exit_code, 0);
  EXPECT_EQ(read_file("c1.png"), read_file("d.png"));
  expect_error(run(render("-o a{n}.png --turntable 12 --frames 6..12")), 2,
               "--frames 12: the pictures are numbered 0 to 11");
}

TEST_F(Program, TwoNamesOfOneFileAreFound) {
  write_file("real.npy", "old");
  expect_error(
      run_shell("ln -s real.npy link.npy; \"$facemap\" " + render("-o a.png --aov z=real.npy --aov id=link.npy")), 2,
      "link.npy: two outputs name this file");
  expect_error(run_shell("mkdir d; \"$facemap\" " + render("-o d/a.png --aov z=d/../d/a.png")), 2,
               "d/../d/a.png: two outputs name this file");
  EXPECT_EQ(read_file("real.npy"), "old");
}

}  // namespace
