#include <string>

#include "cli/program.h"

namespace {

constexpr const char* kView = " --camera 3,2,5 --look-at 0,0,0 --light 4,6,3 --light -5,2,1 --size 48x32 -q ";

TEST_F(Program, ThreadsStrategyAndMemoryLeaveThePictureAsItIs) {
  const std::string planes = " --aov id=id.npy --aov depth=depth.npy --aov lights=lights.npy";
  ASSERT_EQ(run("render cube.obj -o a.png" + planes + kView).exit_code, 0);
  const std::string picture = read_file("a.png"), ids = read_file("id.npy"), depths = read_file("depth.npy"),
                    lights = read_file("lights.npy");
  for (const char* flags : {"--threads 0", "--threads 1", "--threads 2", "--threads 3", "--threads 8",
                            "--strategy auto", "--strategy lists", "--strategy transposed", "--map-memory 64M",
                            "--map-memory 1", "--map-memory 100000K --threads 3 --strategy lists"}) {
    SCOPED_TRACE(flags);
    const Outcome outcome = run("render cube.obj -o a.png " + std::string(flags) + planes + kView);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(read_file("a.png"), picture);
    EXPECT_EQ(read_file("id.npy"), ids);
    EXPECT_EQ(read_file("depth.npy"), depths);
    EXPECT_EQ(read_file("lights.npy"), lights);
  }
}

TEST_F(Program, ThreadsLeaveAMapAsItIs) {
  const std::string map = "map cube.obj --at 0.5,0.25,3 --size 80x60 -q -o ";
  ASSERT_EQ(run(map + "a.png --threads 1").exit_code, 0);
  for (const char* threads : {"0", "2", "7"}) {
    ASSERT_EQ(run(map + "b.png --threads " + threads).exit_code, 0) << threads;
    EXPECT_EQ(read_file("b.png"), read_file("a.png")) << threads;
  }
}

TEST_F(Program, StatisticsSayHowItWasDone) {
  for (const char* strategy : {"lists", "transposed"}) {
    const std::string out =
        run("render cube.obj -o a.png --stats json --threads 3 --strategy " + std::string(strategy) + kView).out;
    EXPECT_NE(out.find("\"threads\": 3,"), std::string::npos) << out;
    EXPECT_NE(out.find("\"strategy\": \"" + std::string(strategy) + "\","), std::string::npos) << out;
    EXPECT_EQ(out.find("\"reason\": \"\""), std::string::npos) << out;
  }
}

TEST_F(Program, TheEnvironmentNamesTheInstructionSet) {
  const std::string render = "\"$facemap\" render cube.obj -o a.png --stats json" + std::string(kView);
  const Outcome scalar = run_shell("FACEMAP_TARGET=scalar " + render);
  EXPECT_EQ(scalar.exit_code, 0);
  EXPECT_NE(scalar.out.find("\"target\": \"scalar\","), std::string::npos) << scalar.out;
  const std::string picture = read_file("a.png");
  ASSERT_EQ(run_shell("FACEMAP_TARGET= " + render).exit_code, 0) << "empty is as good as unset";
  EXPECT_EQ(read_file("a.png"), picture);

  for (const char* command : {"render cube.obj -o b.png", "info cube.obj", "map cube.obj --at 0,0,9 -o b.png"}) {
    expect_error(run_shell("FACEMAP_TARGET=mmx \"$facemap\" " + std::string(command)), 2,
                 "FACEMAP_TARGET must be scalar, sse4, avx2 or avx512, not \"mmx\"");
  }
  EXPECT_EQ(run_shell("FACEMAP_TARGET=mmx \"$facemap\" --help").exit_code, 0);
  EXPECT_EQ(files(), "a.png ");
}

}  // namespace
