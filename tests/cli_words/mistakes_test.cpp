#include <gtest/gtest.h>

#include <set>

#include "anatomy/base/error.h"
#include "apps/cli/usage_words.h"
#include "command_words.h"

/// Values of the wrong kind, words too many or too few: what is said of each.
namespace palpa::cli_words {
namespace {

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(Mistakes, ANumberOfNoKindIsRefusedByEveryOptionThatTakesOne) {
  Commands commands;
  int asked = 0;
  commands.each([&](const Words& path, const cli::CommandText& command) {
    for (const cli::OptionText& option : command.options) {
      if (option.value != "NUMBER") continue;
      const std::string name = option.names.back();
      for (const char* wrong : {"abc", "1,5", "0x10", "nan", "inf", "1e999", "5 ", "--"}) {
        const std::string said = commands.complaintAbout(with(path, {name + "=" + wrong}));
        EXPECT_EQ(faultOf(said), "") << said;
        EXPECT_TRUE(holds(said, name + " needs a ")) << command.path << ": " << said;
        EXPECT_TRUE(holds(said, std::string("not '") + wrong + "'")) << said;
        ++asked;
      }
    }
  });
  EXPECT_GT(asked, 300) << "the walk has lost the numbers";
}

TEST(Mistakes, WithoutItsValueEveryOptionIsNamed) {
  const std::set<std::string> with_or_without{"--simulate", "--list-commands", "--slurm"};
  Commands commands;
  int asked = 0;
  commands.each([&](const Words& path, const cli::CommandText& command) {
    for (const cli::OptionText& option : command.options) {
      const std::string name = option.names.back();
      if (option.value.empty() || with_or_without.contains(name)) continue;
      for (const Words& more : {Words{name}, Words{name, "--help"}}) {
        const std::string said = commands.complaintAbout(with(path, more));
        EXPECT_EQ(faultOf(said), "") << said;
        EXPECT_TRUE(holds(said, name)) << command.path << " " << name << ": " << said;
        ++asked;
      }
    }
  });
  EXPECT_GT(asked, 300) << "the walk has lost the options";
}

struct Mistake {
  const char* name;
  Words words;
  std::string said;  ///< the whole
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

class EachMistake : public testing::TestWithParam<Mistake> {};

TEST_P(EachMistake, IsSaidInOurWords) {
  Commands commands;
  const std::string said = commands.complaintAbout(GetParam().words);
  EXPECT_EQ(faultOf(said), "");
  EXPECT_EQ(said, GetParam().said);
}

INSTANTIATE_TEST_SUITE_P(
    Usage, EachMistake,
    testing::Values(
        Mistake{"Seed",
                {"subclavian", "--seed", "abc"},
                "--seed needs a whole number of 0 or more, not 'abc'. See: palpa subclavian "
                "--help"},
        Mistake{"Trials",
                {"palpation", "--trials", "0"},
                "--trials needs a whole number between 1 and 1000, not '0'. See: palpa palpation "
                "--help"},
        Mistake{"Rate",
                {"squeeze", "--rate", "5"},
                "--rate needs a number between 1000 and 4000 a second, not '5'. See: palpa squeeze "
                "--help"},
        Mistake{"Level",
                {"study", "plan", "--level", "2"},
                "--level needs a number between 0.0001 and 0.5, not '2'. See: palpa study plan "
                "--help"},
        Mistake{"Operator",
                {"subclavian", "--operator", "exprt"},
                "--operator needs auto, expert, novice, person or a file that is there, not "
                "'exprt'; did you mean expert? See: palpa subclavian --help"},
        Mistake{"Option",
                {"subclavian", "--opeartor", "expert"},
                "palpa subclavian has no option --opeartor; did you mean --operator? See: palpa "
                "subclavian --help"},
        Mistake{"OneDash",
                {"subclavian", "-seed", "3"},
                "palpa subclavian has no option -seed; did you mean --seed? See: palpa "
                "subclavian --help"},
        Mistake{"NoDash",
                {"subclavian", "fast"},
                "palpa subclavian takes no word 'fast'; did you mean --fast? See: palpa "
                "subclavian --help"},
        Mistake{"TooEarly",
                {"--seed", "3", "subclavian"},
                "--seed stands before the command it belongs to; write: palpa subclavian --seed. "
                "See: palpa subclavian --help"},
        Mistake{"Report",
                {"report"},
                "palpa report needs to know what to do: certificate, cohort, trainee or trial. "
                "See: palpa "
                "report --help"},
        Mistake{"ReportTrail",
                {"report", "trail", "A"},
                "palpa report has no command 'trail'; did you mean trial? There are certificate, "
                "cohort, "
                "trainee and trial. See: palpa report --help"},
        Mistake{"BoardPaint",
                {"board", "pant"},
                "palpa board has no command 'pant'. There is print. See: palpa board --help"},
        Mistake{"Required",
                {"train", "--fast"},
                "palpa train needs --task FILE. See: palpa train --help"},
        Mistake{"RequiredWord",
                {"replay"},
                "palpa replay needs session FILE. See: palpa replay --help"},
        Mistake{"TooMany",
                {"replay", "a", "b"},
                "palpa replay takes session FILE only once; 'b' is too many. See: palpa replay "
                "--help"},
        Mistake{"Twice",
                {"subclavian", "--seed", "1", "--seed", "2"},
                "--seed NUMBER is given more than once. See: palpa subclavian --help"},
        Mistake{"NoValue",
                {"subclavian", "--seed"},
                "--seed NUMBER needs a value. See: palpa subclavian --help"},
        Mistake{"Swallowed",
                {"subclavian", "--out", "--seed", "1"},
                "--out DIR lacks its value: --seed follows it. See: palpa subclavian --help"},
        Mistake{"SwallowedUnseen",
                {"subclavian", "--out", "--fast"},
                "--out DIR lacks its value: --fast follows it. See: palpa subclavian --help"},
        Mistake{"Three",
                {"calibrate", "force-sensor", "--down", "0", "1"},
                "--down X Y Z needs 3 values. See: palpa calibrate force-sensor --help"},
        Mistake{"FlagWithValue",
                {"subclavian", "--fast=abc"},
                "--fast stands alone, without a value. See: palpa subclavian --help"},
        Mistake{"Needs",
                {"subclavian", "--igtl-listen", "0.0.0.0"},
                "--igtl-listen goes only with --igtl PORT: add that, or leave it out. See: palpa "
                "subclavian --help"},
        Mistake{"Excludes",
                {"patient", "build", "--phantom", "breast", "--sex", "f"},
                "--sex and --phantom do not go together: leave one of them out. See: palpa patient "
                "build --help"},
        Mistake{"Missing",
                {"subclavian", "--station", "no/such/thing"},
                "--station needs a file that is there, not 'no/such/thing'. See: palpa "
                "subclavian --help"},
        Mistake{"Pseudonym",
                {"subclavian", "--trainee", "Jane Doe"},
                "--trainee: a pseudonym has 1 to 32 letters, digits, - or _, and begins with a "
                "letter or a digit. See: palpa subclavian --help"}),
    [](const testing::TestParamInfo<Mistake>& one) { return one.param.name; });

TEST(Mistakes, AShippedFileIsProposedForANameThatIsNearly) {
  Commands commands;
  for (const auto& [option, typed, meant] :
       {std::tuple{"--station", "virtual_bnech.json", "stations/virtual_bench.json"},
        {"--expert-path", "paracentesis_expert_pth.json", "tasks/paracentesis_expert_path.json"}}) {
    const std::string said = commands.complaintAbout({"subclavian", option, typed});
    EXPECT_TRUE(holds(said, std::string(meant) + "?")) << said;
  }
}

TEST(Mistakes, WhatIsTypedInLengthIsCut) {
  Commands commands;
  const std::string said =
      commands.complaintAbout({"subclavian", "--seed", std::string(100'000, '9')});
  EXPECT_LT(said.size(), 250u);
  EXPECT_TRUE(holds(said, "999...'")) << said;
}

// ---- what is thrown

cli::FailureWords told(const std::exception_ptr& thrown, bool verbose = false) {
  return cli::failureWords(thrown, verbose);
}

template <class Thrown>
std::exception_ptr asThrown(const Thrown& what) {
  return std::make_exception_ptr(what);
}

TEST(Failures, OurOwnWordsStayAndTellTheirCode) {
  EXPECT_EQ(told(asThrown(Error("is ill", "x", "Mend it"))).text, "x: is ill. Mend it");
  EXPECT_EQ(told(asThrown(Error("is ill", "x", "Mend it"))).exit_code, 1);
  EXPECT_EQ(told(asThrown(UsageError("is ill", "x", "Mend it"))).exit_code, 2);
}

TEST(Failures, WhatALibrarySaysIsToldToWhoeverAsksOnly) {
  const std::exception_ptr thrown = asThrown(std::runtime_error("json.exception.17 at [3]"));
  EXPECT_FALSE(holds(told(thrown).text, "json")) << told(thrown).text;
  EXPECT_TRUE(holds(told(thrown).text, "--verbose"));
  EXPECT_TRUE(holds(told(thrown, true).text, "json.exception.17 at [3]"));
  EXPECT_EQ(told(thrown).exit_code, 1);
  EXPECT_TRUE(holds(told(asThrown(7)).text, "--verbose"));
}

TEST(Failures, WhatTheSystemRefusesHasItsWord) {
  EXPECT_TRUE(holds(told(asThrown(std::bad_alloc())).text, "not enough memory"));
  EXPECT_FALSE(holds(told(asThrown(std::bad_alloc())).text, "bad_alloc"));
  const auto refused = [](std::errc what) {
    return told(asThrown(std::system_error(std::make_error_code(what), "thread::_M_start"))).text;
  };
  EXPECT_TRUE(holds(refused(std::errc::not_enough_memory), "not enough memory"));
  EXPECT_TRUE(holds(refused(std::errc::resource_unavailable_try_again), "threads"));
  EXPECT_TRUE(holds(refused(std::errc::too_many_files_open), "open files"));
  EXPECT_FALSE(holds(refused(std::errc::no_space_on_device), "_M_start"));
  EXPECT_TRUE(holds(refused(std::errc::no_space_on_device), "the disk is full"));
}

/// Nobody reads the system's English but whoever asks for it.
TEST(Failures, AFileThatTheSystemRefusesIsNamed) {
  const auto code = std::make_error_code(std::errc::permission_denied);
  const auto thrown = asThrown(std::filesystem::filesystem_error("directory_iterator", "/a", code));
  EXPECT_EQ(told(thrown).text,
            "/a: cannot be used (you may not do this with it). Check its name, and who may use it");
  EXPECT_TRUE(holds(told(thrown, true).text, code.message()));
}

}  // namespace
}  // namespace palpa::cli_words
