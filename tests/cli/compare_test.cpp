#include <facemap/image_file.h>

#include "cli/program.h"

namespace {

/// 10 x 10 pixels of level 100, of which the first `changed` have more red by `levels`.
class Compare : public Program {
 protected:
  void write_png(const std::string& name, int changed = 0, std::uint32_t levels = 0, int width = 10) const {
    facemap::Image image;
    image.width = width;
    image.height = 10;
    for (int i = 0; i < width * 10; ++i)
      image.pixels.push_back(facemap::Color::from_24_bit(0x646464 + (i < changed ? levels << 16 : 0)));
    facemap::write_png(image, folder_ / name);
  }

  /// The exit code of comparing a.png with b.png.
  int code(const std::string& flags) const { return run("compare a.png b.png " + flags).exit_code; }
};

TEST_F(Compare, EqualPicturesEndWithZero) {
  write_png("a.png");
  write_png("b.png");
  const Outcome outcome = run("compare a.png b.png");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out,
            "  size                  10x10\n"
            "  unit                  levels, 0 to 255\n"
            "  largest difference    0\n"
            "  mean difference       0\n"
            "  pixels that differ    0 (0 %)\n"
            "  beyond the threshold  0\n"
            "  PSNR                  inf dB\n"
            "  verdict               equal\n");
  EXPECT_EQ(run("compare a.png b.png -q").out, "");
}

TEST_F(Compare, DifferentPicturesEndWithOne) {
  write_png("a.png");
  write_png("b.png", 5, 12);
  const Outcome outcome = run("compare a.png b.png");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.err, "");
  for (const char* line :
       {"  largest difference    12, channel R of pixel 0,0\n", "  mean difference       0.2\n",
        "  pixels that differ    5 (5 %)\n", "  beyond the threshold  5\n", "  verdict               different\n"}) {
    EXPECT_NE(outcome.out.find(line), std::string::npos) << line << "in\n" << outcome.out;
  }
  EXPECT_EQ(run("compare a.png b.png -q").exit_code, 1);
}

TEST_F(Compare, ThresholdsDecide) {
  write_png("a.png");
  write_png("b.png", 5, 12);
  EXPECT_EQ(code("--threshold 12"), 0);
  EXPECT_EQ(code("--threshold 11.9"), 1);
  EXPECT_EQ(code("--max-different 5"), 0);
  EXPECT_EQ(code("--max-different 4"), 1);
  EXPECT_EQ(code("--max-different 5%"), 0);
  EXPECT_EQ(code("--max-different 4.9%"), 1);
  EXPECT_EQ(code("--mean-threshold 0.2"), 0) << "single pixels are free";
  EXPECT_EQ(code("--mean-threshold 0.19"), 1);
  EXPECT_EQ(code("--mean-threshold 0.2 --threshold 11"), 1);
  EXPECT_EQ(code("--mean-threshold 0.1 --threshold 12"), 1);
  EXPECT_EQ(code("--mean-threshold 0.2 --threshold 11 --max-different 5"), 0);
  EXPECT_NE(run("compare a.png b.png --threshold 12").out.find("verdict               equal within the thresholds\n"),
            std::string::npos);
}

TEST_F(Compare, DrawsTheDifferences) {
  write_png("a.png");
  write_png("b.png", 5, 12);
  EXPECT_EQ(code("--difference c.png"), 1);
  const facemap::Picture24 picture = facemap::read_png(folder_ / "c.png");
  EXPECT_EQ(picture.pixels[4], 0xff0000u);
  EXPECT_EQ(picture.pixels[5], 0u);
  EXPECT_EQ(run("compare a.png a.png --difference d.png").exit_code, 0);
  EXPECT_EQ(facemap::read_png(folder_ / "d.png").pixels[0], 0u);
  const std::string old = read_file("a.png");
  expect_error(run("compare a.png b.png --difference ./a.png"), 2, "./a.png: the difference would replace a picture");
  EXPECT_EQ(read_file("a.png"), old);
  expect_error(run("compare a.png b.png --difference -"), 2,
               "--difference: the figures go to standard output; name a file");
  expect_error(run("compare a.png b.png --difference absent/c.png"), 1,
               "absent/c.png: cannot write: there is no folder absent");
  const Outcome full = run("compare a.png b.png --difference /dev/full");
  expect_error(full, 1, "/dev/full: cannot write: No space left on device");
}

TEST_F(Compare, SaysWhyPicturesCannotBeCompared) {
  write_png("a.png");
  write_png("b.png", 0, 0, 12);
  expect_error(run("compare a.png b.png"), 1, "a.png has 10x10 pixels, b.png has 12x10 pixels");
  expect_error(run("compare a.png absent.png"), 1, "absent.png: cannot open: No such file or directory");
  expect_error(run("compare a.png cube.obj"), 1, "cube.obj: it is neither PNG, JPEG, PFM nor EXR");
  write_file("cut.png", read_file("a.png").substr(0, 60));
  expect_error(run("compare a.png cut.png"), 1, "cut.png: PNG cannot be read: it ends too early");
  const std::vector<float> values(300);
  facemap::write_file(folder_ / "c.pfm", facemap::encode_pfm({10, 10, 3, std::span(values)}));
  expect_error(run("compare a.png c.pfm"), 1, "a.png has levels (PNG, JPEG), c.pfm has values (PFM, EXR)");
  expect_error(run("compare a.png b.png --threshold -1"), 2, "--threshold: '-1' is below 0");
  expect_error(run("compare a.png b.png --max-different 101%"), 2, "--max-different: '101%' is above 100%");
  expect_error(run("compare a.png b.png --max-different x"), 2,
               "--max-different: 'x' is not a whole number of 0 to 2147483647");
}

TEST_F(Compare, ReadsValues) {
  std::vector<float> values(300, 0.5f);
  const auto write = [&](const char* name) {
    facemap::write_file(folder_ / name, facemap::encode_pfm({10, 10, 3, std::span<const float>(values)}));
  };
  write("a.pfm");
  values[0] = 0.625f;
  write("b.pfm");
  facemap::ExrLayers layers{{"R", "G", "B"}, {10, 10, 3, std::span<const float>(values)}};
  facemap::write_file(folder_ / "b.exr", facemap::encode_exr({&layers, 1}));
  EXPECT_NE(run("compare a.pfm b.exr").out.find("largest difference    0.125, channel R of pixel 0,0\n"),
            std::string::npos);
  EXPECT_EQ(run("compare b.pfm b.exr").exit_code, 0);
  EXPECT_EQ(run("compare a.pfm b.exr --threshold 0.125").exit_code, 0);
  EXPECT_EQ(run("compare a.pfm b.exr --threshold 0.12").exit_code, 1);
}

}  // namespace
