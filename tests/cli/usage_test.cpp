#include "cli/program.h"

namespace {

TEST_F(Program, SaysItsVersion) {
  const Outcome outcome = run("--version");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, "facemap " FACEMAP_VERSION "\n");
}

TEST_F(Program, HelpNamesEveryCommandAndEachHasItsOwn) {
  const Outcome outcome = run("--help");
  EXPECT_EQ(outcome.exit_code, 0);
  for (const char* command : {"render", "info", "map", "compare", "scene"}) {
    EXPECT_NE(outcome.out.find(std::string("  ") + command + " "), std::string::npos) << command;
    const Outcome help = run(std::string(command) + " --help");
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_NE(help.out.find(std::string("Usage: facemap ") + command), std::string::npos);
    EXPECT_NE(help.out.find("Examples:\n  facemap "), std::string::npos);
    EXPECT_EQ(run(std::string(command) + " model.obj -h").out, help.out);
  }
}

TEST_F(Program, HelpFitsATerminal) {
  for (const char* command : {"", "render", "info", "map", "compare", "scene"}) {
    const std::string help = run(std::string(command) + " --help").out;
    for (std::size_t start = 0, end; start < help.size(); start = end + 1) {
      end = help.find('\n', start);
      EXPECT_LE(end - start, 110u) << help.substr(start, end - start);
    }
  }
}

TEST_F(Program, WithoutACommandShowsTheHelp) {
  expect_error(run(""), 2, "no command is given");
  EXPECT_NE(run("").err.find("Usage: facemap COMMAND"), std::string::npos);
}

TEST_F(Program, SuggestsWhatWasMeant) {
  expect_error(run("rendr"), 2, "unknown command rendr; did you mean render?");
  expect_error(run("--verson"), 2, "unknown option --verson");
  expect_error(run("render cube.obj --fieldangle 30"), 2, "unknown option --fieldangle; did you mean --field-angle?");
  expect_error(run("render cube.obj --look=1,2,3"), 2, "unknown option --look; did you mean --look-at?");
  expect_error(run("render cube.obj --frobnicate"), 2, "unknown option --frobnicate");
  expect_error(run("render cube.obj sphere.obj -o a.png"), 2, "unexpected argument 'sphere.obj'");
}

TEST_F(Program, AsksForWhatIsMissing) {
  expect_error(run("render -o a.png"), 2, "no model is given");
  expect_error(run("render cube.obj"), 2, "no output file is given: add -o FILE, or -o - for standard output");
  expect_error(run("info"), 2, "no model is given");
  expect_error(run("compare a.png"), 2, "two pictures are to be given");
  expect_error(run("map cube.obj -o a.png"), 2, "no place is given: add --at X,Y,Z");
  expect_error(run("scene -o a.obj"), 2, "no scene is named");
  expect_error(run("scene castle -o a.obj"), 2, "SCENE: 'castle' is not chessboard, grass, bust or typewriter");
  EXPECT_EQ(run("render cube.obj -o").exit_code, 2);
}

TEST_F(Program, RefusesAnOptionGivenTwice) {
  expect_error(run("render cube.obj -o a.png --size 8x8 --size 9x9"), 2, "--size is given more than once");
  expect_error(run("render cube.obj -o a.png -o b.png"), 2, "--output is given more than once");
  expect_error(run("render cube.obj -o a.png --aov id=a.npy --aov id=b.npy"), 2, "--aov: id is given more than once");
  EXPECT_EQ(files(), "");
}

TEST_F(Program, RefusesValuesThatMakeNoSense) {
  const std::pair<const char*, const char*> cases[] = {
      {"--size 0x3", "--size: '0x3' is not a size: each side is 1 to 32768 pixels"},
      {"--size 99999x9", "--size: '99999x9' is not a size: each side is 1 to 32768 pixels"},
      {"--size 32768x32768",
       "--size: '32768x32768' is not a size this program takes: 268435456 pixels at most (--max-pixels)"},
      {"--size 99999999999x9", "--size: '99999999999x9' is not a size in pixels such as 1024x768"},
      {"--size 100", "--size: '100' is not a size in pixels such as 1024x768"},
      {"--size 8x8x8", "--size: '8x8x8' is not a size in pixels such as 1024x768"},
      {"--camera nan,1,2", "--camera: 'nan,1,2' is not three numbers x,y,z"},
      {"--camera 1,-inf,2", "--camera: '1,-inf,2' is not three numbers x,y,z"},
      {"--camera 1e39,0,0", "--camera: '1e39,0,0' is not three numbers x,y,z"},
      {"--camera 1,2", "--camera: '1,2' is not three numbers x,y,z"},
      {"--camera 1,2,3,", "--camera: '1,2,3,' is not three numbers x,y,z"},
      {"--camera '1, 2, 3'", "--camera: '1, 2, 3' is not three numbers x,y,z"},
      {"--camera 0x1,2,3", "--camera: '0x1,2,3' is not three numbers x,y,z"},
      {"--light 1,2,3,4", "--light: '1,2,3,4' is not a light x,y,z or x,y,z,r,g,b, with range=R or falloff at the end"},
      {"--field-angle 0", "--field-angle: '0' is not an angle of more than 0 to 360 degrees"},
      {"--field-angle 361", "--field-angle: '361' is not an angle of more than 0 to 360 degrees"},
      {"--projection mercator", "--projection: 'mercator' is not surface or plane"},
      {"--background '#12345'", "--background: '#12345' is not a colour #rrggbb"},
      {"--background '#12345g'", "--background: '#12345g' is not a colour #rrggbb"},
      {"--samples 4", "--samples: '4' is not 1, a grid such as 4x4, or edges"},
      {"--samples 4x5", "--samples: '4x5' is not a square grid of 1x1 to 16x16"},
      {"--samples 17x17", "--samples: '17x17' is not a square grid of 1x1 to 16x16"},
      {"--samples edges:0", "--samples: 'edges:0' is not a square grid of 1x1 to 16x16"},
      {"--intensity bright", "--intensity: 'bright' is not a number"},
      {"--aov id", "--aov id: only an EXR picture has layers; give it a file: id=FILE"},
      {"--aov id=", "--aov: 'id=' names no file"},
      {"--aov uv=uv.pfm", "uv.pfm: PFM holds one or three floats a pixel, which uv is not; write .npy or .exr"},
      {"--aov id=id.hdr", "id.hdr: no format is known by the name .hdr; known are .png, .jpg, .jpeg, .exr, .pfm, .npy"},
      {"--aov id=-", "--aov: standard output takes the picture alone"},
      {"--aov range=a.npy",
       "--aov: 'range' is not id, depth, z, position, normal, face-normal, albedo, uv, object, material, lights or "
       "shadows"},
      {"--format tiff", "--format: 'tiff' is not png, jpeg, exr, pfm or npy"},
      {"--bits 12", "--bits: '12' is not 8, 16 or 32"},
      {"--bits 32", "--bits 32: a channel of png has 8 or 16 bits"},
      {"--bits 16 --format jpeg", "--bits 16: a channel of jpeg has 8 bits"},
      {"--quality 0", "--quality: '0' is not a whole number of 1 to 100"},
      {"--frames 3", "--frames 3: the pictures are numbered 0 to 0"},
      {"--frames 3-1", "--frames: '3-1' ends before it begins"},
      {"--frames 1..x", "--frames: '1..x' is not a picture's number or a range such as 0-9 or 0..9"},
      {"--frames -1", "--frames: '-1' is not a picture's number or a range such as 0-9 or 0..9"},
      {"--threads -1", "--threads: '-1' is not a whole number of 0 to 1024"},
      {"--threads many", "--threads: 'many' is not a whole number of 0 to 1024"},
      {"--strategy fast", "--strategy: 'fast' is not auto, lists or transposed"},
      {"--map-memory much", "--map-memory: 'much' is not an amount of memory such as 512M or 2G"},
      {"--map-memory M", "--map-memory: 'M' is not an amount of memory such as 512M or 2G"},
      {"--map-memory 0", "--map-memory: '0' is not an amount of memory such as 512M or 2G"},
      {"--map-memory -1G", "--map-memory: '-1G' is not an amount of memory such as 512M or 2G"},
      {"--map-memory 1.5G", "--map-memory: '1.5G' is not an amount of memory such as 512M or 2G"},
      {"--map-memory 99999999T", "--map-memory: '99999999T' is not an amount of memory such as 512M or 2G"},
      {"--stats xml", "--stats: 'xml' is not json or text"},
      {"--terminator-fix maybe", "--terminator-fix: 'maybe' is not off or on"},
  };
  for (const auto& [flags, message] : cases) {
    SCOPED_TRACE(flags);
    expect_error(run(std::string("render cube.obj -o a.png ") + flags), 2, message);
  }
  EXPECT_EQ(files(), "");
}

TEST_F(Program, HelpAsAPageHoldsEveryHelp) {
  const std::string page = run("--help-markdown").out;
  for (const char* command : {"", "render", "info", "map", "compare", "scene"}) {
    EXPECT_NE(page.find(run(std::string(command) + " --help").out), std::string::npos) << command;
  }
  EXPECT_TRUE(page == text_of_file(FACEMAP_SOURCE_DIR "/docs/cli.md"))
      << "docs/cli.md is behind: build/release/bin/facemap --help-markdown >docs/cli.md";
}

}  // namespace
