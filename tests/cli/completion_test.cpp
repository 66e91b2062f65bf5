// What shells complete, and the manual page: both are made from the table of options.

#include "cli/program.h"

namespace {

class Completion : public Program {
 protected:
  std::string offers(const std::string& words, int place) const {
    const std::string script =
        "\"$facemap\" --completion bash > complete.bash && bash -c '. ./complete.bash; COMP_WORDS=(" + words +
        "); COMP_CWORD=" + std::to_string(place) + "; _facemap; echo \"${COMPREPLY[@]}\"'";
    const Outcome outcome = run_shell(script);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out;
  }
};

TEST_F(Completion, BashOffersCommandsFlagsAndValues) {
  EXPECT_EQ(offers("facemap re", 1), "render\n");
  EXPECT_EQ(offers("facemap render cube.obj --look", 3), "--look-at\n");
  EXPECT_EQ(offers("facemap render --projection \"\"", 3), "surface plane\n");
  EXPECT_EQ(offers("facemap render --projection p", 3), "plane\n");
  EXPECT_EQ(offers("facemap render cu", 2), "\n");  // a file's name: bash's own completion takes over
  EXPECT_EQ(offers("facemap --completion z", 2), "zsh\n");
  EXPECT_EQ(offers("facemap m.obj --sam", 2), "--samples\n");
  EXPECT_EQ(offers("facemap m.obj --projection p", 3), "plane\n");
  EXPECT_EQ(offers("facemap scene che", 2), "chessboard\n");
  EXPECT_EQ(offers("facemap scene -o che", 3), "\n");
}

TEST_F(Completion, EveryFlagIsInEachScriptAndInTheManual) {
  const std::string help = run("render --help").out;
  const std::string manual = run("--man").out;
  const std::string bash = run("--completion bash").out, zsh = run("--completion zsh").out,
                    fish = run("--completion fish").out;
  int flags = 0;
  for (std::size_t at = help.find(" --"); at != std::string::npos; at = help.find(" --", at + 1)) {
    const std::size_t end = help.find_first_not_of("abcdefghijklmnopqrstuvwxyz-", at + 1);
    const std::string flag = help.substr(at + 1, end - at - 1);
    if (flag == "--help") continue;
    ++flags;
    std::string in_roff;
    for (const char c : flag) in_roff += c == '-' ? std::string("\\-") : std::string(1, c);
    EXPECT_NE(manual.find(in_roff), std::string::npos) << flag;
    EXPECT_NE(bash.find(flag), std::string::npos) << flag;
    EXPECT_NE(zsh.find(flag), std::string::npos) << flag;
    EXPECT_NE(fish.find("-l " + flag.substr(2)), std::string::npos) << flag;
  }
  EXPECT_GT(flags, 15);
}

TEST_F(Completion, AModelMayStandForTheCommand) {
  EXPECT_NE(run("--completion zsh").out.find("    _files\n"), std::string::npos);
  EXPECT_NE(run("--completion zsh").out.find("    *)\n"), std::string::npos);
  EXPECT_EQ(run("--completion fish").out.find("__fish_use_subcommand -f"), std::string::npos);
  EXPECT_NE(run("--completion fish").out.find("'not __fish_seen_subcommand_from info"), std::string::npos);
  EXPECT_NE(run("--man").out.find("\\fIMODEL\\fR [\\fIoptions of facemap render"), std::string::npos);
}

TEST_F(Completion, RefusesOtherShells) {
  expect_error(run("--completion tcsh"), 2, "--completion: name a shell: bash, zsh or fish");
  expect_error(run("--completion"), 2, "--completion: name a shell: bash, zsh or fish");
}

}  // namespace
