#include "commands.h"

#include <gtest/gtest.h>

#include "tree.h"

namespace palpa::guide {
namespace {

TEST(Commands, AreParted) {
  EXPECT_EQ(wordsOf("palpa a --b 'c d' | x # no"),
            (std::vector<std::string>{"palpa", "a", "--b", "c d", "|", "x"}));
  EXPECT_EQ(wordsOf("a && b; c & # d"), (std::vector<std::string>{"a", "&&", "b", ";", "c", "&"}));
  EXPECT_TRUE(wordsOf("  # only words").empty());
  EXPECT_EQ(wordsOf("echo '' x#y"), (std::vector<std::string>{"echo", "", "x#y"}));
}

TEST(Commands, AreReadFromABlock) {
  const std::vector<Command> all = commandsOf(
      {"sh", "slow", "# words\npalpa a \\\n  --b\n\npalpa c   # exits with 2: why\n", 10});
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].text, "palpa a    --b");
  EXPECT_EQ(all[0].line, 11);
  EXPECT_EQ(all[0].exit_code, 0);
  EXPECT_TRUE(all[0].slow);
  EXPECT_EQ(all[1].line, 14);
  EXPECT_EQ(all[1].exit_code, 2);
}

TEST(Commands, UnknownOnesAreFound) {
  const Known known(
      "\\fB\\-\\-version\\fR\n.SS palpa doctor\n.TP\n\\fB\\-\\-station\\fR \\fIFILE\\fR\nFile; see "
      "\\-\\-none\n.SS palpa board print\n.TP\n\\fB\\-o\\fR, \\fB\\-\\-out\\fR\n.SH "
      "FILES\n\\fB\\-\\-not\\fR\n");
  EXPECT_EQ(known.commands(), 2u);
  for (const char* right :
       {"palpa", "palpa --version", "palpa doctor --station x", "palpa board print --out=b.png",
        "palpa board --help", "./run doctor", "A=1 palpa doctor; ls --none", "palpa COMMAND --help",
        "palpa <cmd> --help", "for s in 1 2; do palpa doctor --station $s; done", "man palpa",
        "xdg-open palpa --x", "echo '; palpa nothing'"})
    EXPECT_EQ(known.faultOf(std::string(right)), "") << right;
  for (const char* wrong :
       {"palpa doctr", "palpa doctor --stations x", "palpa doctor --none", "palpa board paint",
        "palpa board --out x", "ls && palpa doctor --not", "palpa --verbose",
        "build/check/palpa doctor --x", "for s in 1; do palpa doctor --y $s; done"})
    EXPECT_NE(known.faultOf(std::string(wrong)), "") << wrong;
}

// Everything that looks like a command of the program, in every page of the project.
TEST(Commands, InPagesAreKnownToTheProgram) {
  const Known known;
  EXPECT_GE(known.commands(), 40u) << "palpa manual names all commands";
  int looked = 0;
  for (const std::filesystem::path& file : pagesOfTheProject()) {
    const Page page = readPage(file);
    const auto look = [&](const std::string& text, int line) {
      looked += text.find("palpa ") != std::string::npos;
      EXPECT_EQ(known.faultOf(text), "") << file << ":" << line << ": " << text;
    };
    for (const Code& code : page.code) look(code.text, code.line);
    for (const Block& block : page.blocks)
      for (const Command& command : commandsOf(block)) look(command.text, command.line);
  }
  EXPECT_GE(looked, 150) << "the README alone has so many";
}

// In the guide an option is named alone as well: `--fast`.
TEST(Commands, OptionsNamedAloneAreKnown) {
  const Known known;
  for (const std::filesystem::path& file : chapters())
    for (const Code& code : readPage(file).code)
      if (code.text.starts_with("--")) {
        const std::string option = code.text.substr(0, code.text.find_first_of(" =,"));
        EXPECT_TRUE(known.anyHas(option))
            << file << ":" << code.line << ": no command has " << option;
      }
}

// What looks like a command and is not marked sh would not be run.
TEST(Commands, OfTheGuideStandWhereTheyAreRun) {
  for (const std::filesystem::path& file : chapters())
    for (const Block& block : readPage(file).blocks) {
      if (block.language == "sh") {
        EXPECT_TRUE(block.rest.empty() || block.rest == "slow")
            << file << ":" << block.line << ": unknown mark \"" << block.rest << "\"";
        continue;
      }
      EXPECT_FALSE(block.language.empty())
          << file << ":" << block.line << ": a block without a language";
      EXPECT_TRUE(("\n" + block.text).find("\npalpa ") == std::string::npos)
          << file << ":" << block.line << ": a command that no test runs; mark the block sh";
    }
}

}  // namespace
}  // namespace palpa::guide
