#include <gtest/gtest.h>

#include "program.h"

/// Help, mistakes on the command line, contradictions: code 2 and one line that says what to do.
namespace palpa::cli_test {
namespace {

using Arguments = std::vector<std::string>;

std::string joined(const Arguments& arguments) {
  std::string text;
  for (const std::string& a : arguments) text += " " + a;
  return text;
}

void expectWrongUsage(const Arguments& arguments, const std::string& word) {
  const Folder here;
  const Outcome outcome = palpa(arguments, here.path());
  EXPECT_EQ(outcome.exit_code, 2) << joined(arguments) << ": " << outcome.err;
  EXPECT_EQ(outcome.errLines(), 1) << outcome.err;
  EXPECT_EQ(outcome.err.rfind("palpa: ", 0), 0u) << outcome.err;
  EXPECT_NE(outcome.err.find(word), std::string::npos) << joined(arguments) << ": " << outcome.err;
  EXPECT_TRUE(here.files().empty()) << here.files().front();
}

/// Whoever learnt the command of before is not left alone.
TEST(Usage, TheNameOfBeforeWorksAndNamesTheNewOne) {
  const Folder here;
  const Outcome old = palpa({"paracentesis", "--help"}, here.path());
  EXPECT_EQ(old.exit_code, 0);
  EXPECT_EQ(old.err, "palpa paracentesis is called palpa subclavian now\n");
  EXPECT_EQ(old.out, palpa({"subclavian", "--help"}, here.path()).out);
}

TEST(Usage, WithoutArgumentsItSaysWhatCanBeDone) {
  const Folder here;
  const Outcome outcome = palpa({}, here.path());
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  for (const char* word :
       {"palpa subclavian", "palpa replay", "virtual bench", "report.html", "--help"})
    EXPECT_NE(outcome.out.find(word), std::string::npos) << word;
  EXPECT_TRUE(here.files().empty());
}

TEST(Usage, EveryCommandExplainsItselfWithAnExample) {
  const Folder here;
  for (const Arguments& command : {Arguments{},
                                   {"subclavian"},
                                   {"train"},
                                   {"replay"},
                                   {"export"},
                                   {"calibrate", "experts"},
                                   {"patient", "build"},
                                   {"patient", "info"},
                                   {"board", "print"}}) {
    Arguments arguments = command;
    arguments.push_back("--help");
    const Outcome outcome = palpa(arguments, here.path());
    EXPECT_EQ(outcome.exit_code, 0) << joined(arguments);
    EXPECT_EQ(outcome.err, "") << joined(arguments);
    EXPECT_NE(outcome.out.find("Example"), std::string::npos) << joined(arguments);
    EXPECT_NE(outcome.out.find("palpa " + (command.empty() ? "subclavian" : command.front())),
              std::string::npos)
        << joined(arguments);
  }
}

TEST(Usage, GroupsListTheirCommands) {
  const Folder here;
  for (const auto& [group, command] :
       {std::pair{"calibrate", "experts"}, {"patient", "build"}, {"board", "print"}}) {
    const Outcome outcome = palpa({group, "--help"}, here.path());
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.out.find(command), std::string::npos) << group;
    expectWrongUsage({group}, command);
  }
}

TEST(Usage, VersionIsTold) {
  const Folder here;
  const Outcome outcome = palpa({"--version"}, here.path());
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out.rfind("palpa ", 0), 0u) << outcome.out;
}

TEST(Usage, UnknownWordsAreRefused) {
  expectWrongUsage({"parasentesis"}, "parasentesis");
  expectWrongUsage({"--sed", "1"}, "--sed");
  expectWrongUsage(session({"--sed", "1"}), "--sed");
  expectWrongUsage(session({"left"}), "left");
  expectWrongUsage({"board", "paint"}, "There is print");
}

TEST(Usage, ValuesOutsideTheirKindAreRefused) {
  expectWrongUsage(session({"--operator", "surgeon"}), "--operator");
  expectWrongUsage(session({"--side", "front"}), "--side");
  expectWrongUsage(session({"--force-feedback", "yes"}), "--force-feedback");
  expectWrongUsage(session({"--seed", "many"}), "--seed");
  expectWrongUsage(session({"--seed", "-1"}), "--seed");
  expectWrongUsage(session({"--seed"}), "--seed");
  expectWrongUsage(session({"--trials", "0"}), "--trials");
  expectWrongUsage(session({"--trials", "-3"}), "--trials");
  expectWrongUsage(session({"--trials", "1.5"}), "--trials");
  expectWrongUsage(session({"--patient-seed", "-1"}), "--patient-seed");
  expectWrongUsage({"patient", "build", "--seed", "-1"}, "--seed");
  expectWrongUsage({"board", "print", "--dpi", "5"}, "--dpi");
  expectWrongUsage({"patient", "build", "--side", "both"}, "--side");
}

TEST(Usage, ATraineeIsAPseudonymNotAPathOrMarkup) {
  for (const char* id : {"", "Jane Doe", "../x", "<b>", "a,b", "a\"b", "\xc3\xa9",
                         "abcdefghijklmnopqrstuvwxyz0123456"})
    expectWrongUsage(session({"--trainee", id}), "pseudonym");
}

TEST(Usage, ContradictionsAreRefused) {
  expectWrongUsage({"subclavian", "--operator", "person", "--fast", "--quiet"}, "--fast");
  expectWrongUsage({"subclavian", "--operator", "person", "--no-views", "--quiet"},
                   "--operator person");
  expectWrongUsage({"subclavian", "--operator", "person", "--quiet"}, "DISPLAY");
  expectWrongUsage(session({"--display", "window"}), "--display window");
  expectWrongUsage({"subclavian", "--operator", "expert", "--fast", "--tracking", "model"},
                   "--no-views");
  expectWrongUsage(session({"--camera", "*.png"}), "--intrinsics");
  expectWrongUsage(session({"--camera", "*.png", "--intrinsics", "a.yml"}), "--board");
  expectWrongUsage(session({"--board", "chessboard:9x6:0.025"}), "--camera");
  expectWrongUsage({"calibrate", "experts"}, "--simulate");
  expectWrongUsage({"train", "--fast"}, "--task");
  expectWrongUsage({"replay"}, "session");
}

TEST(Usage, ASurfaceInTheWrongUnitIsRefusedWithTheLikelyOne) {
  // A bar 149 x 12 x 12, as a clavicle would be in millimetres.
  std::string obj;
  for (int i = 0; i < 8; ++i)
    obj += "v " + std::to_string(i & 1 ? 149 : 0) + " " + std::to_string(i & 2 ? 12 : 0) + " " +
           std::to_string(i & 4 ? 12 : 0) + "\n";
  obj += "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  Folder here;
  const std::string file = here.file("bar.obj", obj);
  const Outcome wrong = palpa({"patient", "info", file, "--organ", "clavicle"}, here.path());
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_EQ(wrong.errLines(), 1);
  EXPECT_EQ(wrong.out, "");
  EXPECT_NE(wrong.err.find("a clavicle of 149 m"), std::string::npos) << wrong.err;
  EXPECT_NE(wrong.err.find("--unit mm"), std::string::npos) << wrong.err;
  const Outcome unknown = palpa({"patient", "info", file, "--unit", "furlong"}, here.path());
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_EQ(unknown.errLines(), 1) << unknown.err;
  EXPECT_NE(unknown.err.find("furlong"), std::string::npos);
  const Outcome right =
      palpa({"patient", "info", file, "--organ", "clavicle", "--unit", "mm"}, here.path());
  EXPECT_EQ(right.exit_code, 0) << right.err;
  EXPECT_NE(right.out.find("149 mm x 12 mm x 12 mm  sound"), std::string::npos) << right.out;
}

}  // namespace
}  // namespace palpa::cli_test
