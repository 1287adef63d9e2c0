#include <gtest/gtest.h>

#include <set>

#include "command_words.h"

/// A hand that slips on a word of the command line is told the word that it meant.
namespace palpa::cli_words {
namespace {

Words with(Words words, const std::string& more) {
  words.push_back(more);
  return words;
}

/// How often the right word was proposed.
struct Tally {
  int slips = 0, right = 0;
  void count(bool is_right) {
    ++slips;
    right += is_right;
  }
  double share() const { return static_cast<double>(right) / slips; }
};

std::set<std::string> namesOf(const cli::CommandText& command) {
  std::set<std::string> names;
  for (const cli::OptionText& option : command.options)
    names.insert(option.names.begin(), option.names.end());
  return names;
}

TEST(Slips, OnAnOptionOfAnyCommandTheRightOneIsProposed) {
  Commands commands;
  Tally tally;
  commands.each([&](const Words& path, const cli::CommandText& command) {
    const std::set<std::string> names = namesOf(command);
    for (const std::string& name : names) {
      if (name.rfind("--", 0) != 0) continue;
      for (const std::string& slip : slipsOf(name)) {
        if (names.count(slip)) continue;
        const std::string said = commands.complaintAbout(with(path, slip));
        ASSERT_EQ(faultOf(said), "") << said;
        ASSERT_TRUE(holds(said, "no option " + slip)) << said;
        ASSERT_TRUE(holds(said, command.path + " --help")) << said;
        tally.count(holds(said, "did you mean " + name + "?"));
      }
    }
  });
  EXPECT_GT(tally.slips, 5000) << "the walk has lost the commands";
  EXPECT_GE(tally.share(), 0.95);
}

TEST(Slips, OnACommandTheRightOneIsProposedAndAllAreNamed) {
  Commands commands;
  Tally tally;
  commands.each([&](const Words& path, const cli::CommandText& command) {
    std::set<std::string> names;
    for (const cli::CommandText& below : command.commands)
      names.insert(below.path.substr(command.path.size() + 1));
    for (const std::string& name : names)
      for (const std::string& slip : slipsOf(name)) {
        if (names.count(slip)) continue;
        const std::string said = commands.complaintAbout(with(path, slip));
        ASSERT_EQ(faultOf(said), "") << said;
        ASSERT_TRUE(holds(said, "no command '" + slip + "'")) << said;
        for (const std::string& other : names) ASSERT_TRUE(holds(said, other)) << said;
        tally.count(holds(said, "did you mean " + name + "?"));
      }
  });
  EXPECT_GT(tally.slips, 1000) << "the walk has lost the commands";
  EXPECT_GE(tally.share(), 0.95);
}

TEST(Slips, OnAWordToChooseTheRightOneIsProposedAndAllAreNamed) {
  Commands commands;
  Tally tally;
  commands.each([&](const Words& path, const cli::CommandText& command) {
    for (const cli::OptionText& option : command.options)
      for (const std::string& choice : option.choices) {
        if (choice.size() < 3) continue;  // "on", "f": any letter is as near
        for (const std::string& slip : slipsOf(choice)) {
          if (std::count(option.choices.begin(), option.choices.end(), slip)) continue;
          const std::string said =
              commands.complaintAbout(with(with(path, option.names.back()), slip));
          ASSERT_EQ(faultOf(said), "") << said;
          ASSERT_TRUE(holds(said, option.names.back() + " needs ")) << said;
          for (const std::string& other : option.choices)
            ASSERT_TRUE(holds(said, other)) << said << ", " << other;
          tally.count(holds(said, "did you mean " + choice + "?"));
        }
      }
  });
  EXPECT_GT(tally.slips, 500) << "the walk has lost the choices";
  EXPECT_GE(tally.share(), 0.95);
}

TEST(Slips, WhereNothingIsNearNothingIsProposed) {
  Commands commands;
  for (const Words& words :
       {Words{"qqqqqqq"}, {"subclavian", "--qqqqqqq"}, {"report", "qqqqqqq"}}) {
    const std::string said = commands.complaintAbout(words);
    EXPECT_EQ(faultOf(said), "") << said;
    EXPECT_TRUE(holds(said, "qqqqqqq")) << said;
    EXPECT_FALSE(holds(said, "did you mean")) << said;
  }
}

/// Not those of the program, or of the group that it stands in.
TEST(Help, EachCommandShowsExamplesOfItsOwn) {
  int commands = 0;
  Commands().each([&](const Words& path, const cli::CommandText& command) {
    if (path.empty()) return;
    ++commands;
    EXPECT_TRUE(holds(command.footer, "xample")) << command.path;
    EXPECT_TRUE(holds(command.footer, command.path)) << command.path << "\n" << command.footer;
  });
  EXPECT_GT(commands, 50) << "the walk has lost the commands";
}

}  // namespace
}  // namespace palpa::cli_words
