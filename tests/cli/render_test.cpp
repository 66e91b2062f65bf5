#include <facemap/image.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <vector>

#include "cli/program.h"

namespace {

constexpr const char* kView = " --camera 3,2,5 --look-at 0,0,0 --light 4,6,3 --size 48x32 -q ";

/// The numbers of a .npy file, which its header precedes.
template <typename Value>
std::vector<Value> npy_values(const std::string& bytes) {
  const std::size_t start = bytes.find('\n') + 1;
  std::vector<Value> values((bytes.size() - start) / sizeof(Value));
  std::memcpy(values.data(), bytes.data() + start, values.size() * sizeof(Value));
  return values;
}

TEST_F(Program, DrawsACubeAndSaysNothing) {
  const Outcome outcome = run(std::string("render cube.obj -o a.png") + kView);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
  const facemap::Picture24 picture = facemap::read_png(folder_ / "a.png");
  EXPECT_EQ(picture.width, 48);
  EXPECT_EQ(picture.height, 32);
  EXPECT_EQ(picture.pixels[0], 0u);
  EXPECT_GT(picture.pixels[16 * 48 + 24], 0u);
  EXPECT_EQ(files(), "a.png ");
}

TEST_F(Program, PrintsWhatItMadeUpAsFlagsThatGiveTheSamePicture) {
  const Outcome made_up = run("render cube.obj -o a.png --size 40x40");
  EXPECT_EQ(made_up.exit_code, 0);
  EXPECT_EQ(made_up.out, "");
  const std::string view_line = "facemap: view: ", lights_line = "facemap: lights: ";
  ASSERT_EQ(made_up.err.find(view_line), 0u) << made_up.err;
  std::string flags = made_up.err.substr(view_line.size());
  const std::size_t lights = flags.find('\n');
  ASSERT_EQ(flags.substr(lights + 1, lights_line.size()), lights_line);
  flags.replace(lights, 1 + lights_line.size(), " ");
  flags.pop_back();

  const Outcome repeated = run("render cube.obj -o b.png --size 40x40 " + flags);
  EXPECT_EQ(repeated.err, "") << "nothing is left to make up";
  EXPECT_EQ(read_file("a.png"), read_file("b.png"));
}

TEST_F(Program, CompletesAPartOfAView) {
  EXPECT_NE(run("render cube.obj -o a.png --size 8x8 --camera -1,2.5,-7")
                .err.find("--camera -1,2.5,-7 --look-at 0,0,0 --up 0,1,0"),
            std::string::npos);
  EXPECT_NE(run("render cube.obj -o a.png --size 8x8 --camera 0,9,0").err.find("--look-at 0,0,0 --up 0,0,1"),
            std::string::npos)
      << "a sight along +y needs another up";
  EXPECT_NE(run("render cube.obj -o a.png --size 8x8 --camera 0,0,0").err.find("--look-at 0,0,-1"), std::string::npos);
  EXPECT_NE(run("render cube.obj -o a.png --size 8x8 --look-at 5,5,5").err.find("--look-at 5,5,5"), std::string::npos);
}

TEST_F(Program, TakesNumbersInAnyForm) {
  for (const char* camera : {"-1,2,3", "-.5,+2,3e0", "-1e-50,2,3"}) {
    EXPECT_EQ(run(std::string("render cube.obj -o a.png --size 8x8 -q --camera ") + camera).exit_code, 0) << camera;
    EXPECT_EQ(run(std::string("render cube.obj -o a.png --size 8x8 -q --camera=") + camera).exit_code, 0) << camera;
  }
  const std::string command = "\"$facemap\" render cube.obj -o b.png --size 8x8 -q --camera -1.5,2.5,3.5";
  ASSERT_EQ(run_shell("LC_ALL=C " + command).exit_code, 0);
  const std::string picture = read_file("b.png");
  ASSERT_EQ(run_shell("LC_ALL=de_DE.UTF-8 " + command).exit_code, 0);
  EXPECT_EQ(read_file("b.png"), picture);
}

TEST_F(Program, WritesPlanes) {
  const Outcome outcome =
      run(std::string("render cube.obj -o a.png --aov id=id.npy --aov depth=depth.npy --aov lights=lights.npy "
                      "--light -9,0,0 ") +
          kView);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(files(), "a.png depth.npy id.npy lights.npy ");
  const auto ids = npy_values<std::int32_t>(read_file("id.npy"));
  const auto depths = npy_values<float>(read_file("depth.npy"));
  const auto lights = npy_values<std::uint8_t>(read_file("lights.npy"));
  ASSERT_EQ(ids.size(), 48u * 32u);
  ASSERT_EQ(depths.size(), ids.size());
  ASSERT_EQ(lights.size(), ids.size());
  EXPECT_EQ(ids[0], -1);
  EXPECT_EQ(depths[0], std::numeric_limits<float>::infinity());
  EXPECT_EQ(lights[0], 0);
  const std::size_t middle = 16 * 48 + 24;
  EXPECT_GE(ids[middle], 0);
  EXPECT_GT(depths[middle], 4);  // the camera is 6.16 from the cube's centre, the cube reaches 1.73 from it
  EXPECT_LT(depths[middle], 6.2);
  EXPECT_EQ(*std::max_element(lights.begin(), lights.end()), 2)
      << "of three faces in sight the later light reaches all, the first none";
}

TEST_F(Program, WritesAPictureToStandardOutput) {
  ASSERT_EQ(run(std::string("render cube.obj -o a.png") + kView).exit_code, 0);
  const Outcome outcome = run(std::string("render cube.obj -o -") + kView);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, read_file("a.png"));
  expect_error(run(std::string("render cube.obj -o - --stats json") + kView), 2,
               "-o - and --stats would both write to standard output");
  const Outcome full = run_shell(std::string("\"$facemap\" render cube.obj -o - >/dev/full") + kView);
  expect_error(full, 1, "standard output: cannot write: No space left on device");
}

TEST_F(Program, PrintsStatisticsAsText) {
  const Outcome outcome = run(std::string("render cube.obj -o a.png --stats text --threads 2") + kView);
  EXPECT_EQ(outcome.exit_code, 0);
  for (const char* part : {"\nfaces                     12\n", "\nthreads                   2\n",
                           "\nmilliseconds.load         ", "\nlight_tests.by_exact      ", "\nstrategy "}) {
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part << " in\n" << outcome.out;
  }
}

TEST_F(Program, PrintsStatisticsAsJson) {
  const Outcome outcome = run(std::string("render cube.obj -o a.png --stats json") + kView);
  EXPECT_EQ(outcome.exit_code, 0);
  for (const char* part : {"\"faces\": 12,", "\"lights\": 1,", "\"frames\": 1,", "\"threads\": ", "\"target\": \"",
                           "\"strategy\": \"", "\"reason\": \"", "\"milliseconds\": {\"load\": ", "\"camera_map\": ",
                           "\"light_maps\": ", "\"shade\": ", "\"write\": ", "\"peak_memory_bytes\": ",
                           "\"map_bytes\": ", "\"by_float\": ", "\"by_double\": ", "\"by_exact\": "}) {
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part << " in\n" << outcome.out;
  }
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '{'),
            std::count(outcome.out.begin(), outcome.out.end(), '}'));
}

TEST_F(Program, EveryOptionReachesThePicture) {
  ASSERT_EQ(run(std::string("render cube.obj -o a.png") + kView).exit_code, 0);
  const std::string plain = read_file("a.png");
  for (const char* flags : {"--field-angle 30", "--projection plane", "--up 1,1,0", "--light -9,9,9,0.3,0,0",
                            "--intensity 0.5", "--falloff inverse-square", "--background '#8090a0'",
                            "--background 0,0.5,0", "--samples 4x4", "--samples '4*4'", "--samples edges"}) {
    ASSERT_EQ(run(std::string("render cube.obj -o b.png ") + flags + kView).exit_code, 0) << flags;
    EXPECT_NE(read_file("b.png"), plain) << flags;
  }
  for (const char* flags :
       {"--samples 1", "--samples 1x1", "--projection surface", "--builder cover", "--falloff constant",
        "--normals flat", "--terminator-fix off", "--intensity 1", "--background '#000000'"}) {
    ASSERT_EQ(run(std::string("render cube.obj -o b.png ") + flags + kView).exit_code, 0) << flags;
    EXPECT_EQ(read_file("b.png"), plain) << flags << ": the default, or nothing to a cube without normals";
  }
}

TEST_F(Program, BackgroundIsTheColorThatWasSaid) {
  ASSERT_EQ(run(std::string("render cube.obj -o a.png --background '#8090a0'") + kView).exit_code, 0);
  EXPECT_EQ(facemap::read_png(folder_ / "a.png").pixels[0], 0x8090a0u);
  ASSERT_EQ(run(std::string("render cube.obj -o a.png --background 1,0.5,0") + kView).exit_code, 0);
  EXPECT_EQ(facemap::read_png(folder_ / "a.png").pixels[0], 0xffbc00u);
}

}  // namespace
