#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "anatomy/base/whole_file.h"
#include "program.h"
#include "tests/support/setting.h"

/// Words are said in a language; what is recorded, and what programs read, is not.
namespace palpa::cli_test {
namespace {

std::string textOf(const std::filesystem::path& file) { return readWhole(file).value_or(""); }

Outcome sessionIn(const std::string& language, const std::string& out, const Folder& here) {
  return palpa(quickly({"subclavian", "--operator", "novice", "--seed", "3", "--language", language,
                        "--assess", "--out", out}),
               here.path());
}

/// Words of a page that bear no marks of the language that nobody speaks: with at least three
/// letters, and between blanks, so that they are no part of a name.
std::vector<std::string> unmarkedWords(std::string page) {
  page = std::regex_replace(page, std::regex("<(style|script)[^>]*>[^]*?</(style|script)>"), " ");
  page = std::regex_replace(page, std::regex("<(\\w+) translate=\"no\">[^<]*</\\1>"), " ");
  page = std::regex_replace(page, std::regex("<[^>]*>"), "\n");
  std::vector<std::string> words;
  const std::regex word("(^|[\\s(])([A-Za-z]{3,})(?=$|[\\s.,;:)])");
  for (std::sregex_iterator at(page.begin(), page.end(), word), end; at != end; ++at)
    words.push_back((*at)[2]);
  return words;
}

TEST(Language, ChangesNoFileThatProgramsRead) {
  const Folder here;
  for (const auto& [language, out] : {std::pair{"en", "A"}, {"el", "B"}}) {
    const Outcome session = sessionIn(language, out, here);
    ASSERT_EQ(session.exit_code, 0) << session.err;
    const Outcome exported =
        palpa({"export", std::string(out) + "/session.palpa", "--out", std::string(out) + ".csv"},
              here.path());
    ASSERT_EQ(exported.exit_code, 0) << exported.err;
  }
  EXPECT_FALSE(textOf(here / "A.csv").empty());
  EXPECT_EQ(textOf(here / "A/trials.csv"), textOf(here / "B/trials.csv"));
  EXPECT_EQ(textOf(here / "A.csv"), textOf(here / "B.csv"));
  EXPECT_TRUE(says(textOf(here / "A/report.html"), "<html lang=\"en\">"));
  EXPECT_TRUE(says(textOf(here / "B/report.html"), "<html lang=\"el\">"));
  EXPECT_TRUE(says(textOf(here / "B/report.html"), "Τι χρεώθηκε και γιατί"));
}

TEST(Language, LeavesNoWordOfAReportWithoutAMessage) {
  const Folder here;
  const Outcome session = sessionIn("qps", "Q", here);
  ASSERT_EQ(session.exit_code, 0) << session.err;
  for (const std::string& word : unmarkedWords(textOf(here / "Q/report.html")))
    EXPECT_EQ(word, "BMI") << "a measure";
}

TEST(Language, IsSpokenOnTheTerminalWithoutThatLocale) {
  const Folder here;
  const Outcome help = palpa({"doctor", "--help", "--language", "el"}, here.path());
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_TRUE(says(help.out, "Είναι έτοιμος αυτός ο σταθμός;")) << help.out;
  EXPECT_TRUE(says(help.out, "--station")) << help.out;
  const test::Setting all("LC_ALL", "el_GR.UTF-8");
  EXPECT_TRUE(says(palpa({"doctor", "--help"}, here.path()).out, "σταθμός"));
  const Outcome json = palpa({"doctor", "--json"}, here.path());
  EXPECT_TRUE(says(json.out, "\"can_start\"")) << json.out;
}

TEST(Language, ThatIsNotThereIsRefusedInAWord) {
  const Folder here;
  const Outcome none = palpa({"doctor", "--language", "xx"}, here.path());
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_TRUE(says(none.err, "\"xx\": is no language of this program. Known: de, el, en"))
      << none.err;
  EXPECT_EQ(palpa({"doctor", "--language"}, here.path()).exit_code, 2);
}

}  // namespace
}  // namespace palpa::cli_test
