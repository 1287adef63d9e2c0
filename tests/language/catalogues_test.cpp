#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "apps/language/languages.h"
#include "apps/language/po_file.h"
#include "tests/support/files.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/setting.h"

namespace palpa::language {
namespace {

const std::filesystem::path kFolder = std::filesystem::path(PALPA_SOURCE_DIR) / "assets/languages";

std::vector<std::string> shipped() {
  std::vector<std::string> codes;
  for (const Language& one : languagesIn(kFolder)) codes.push_back(one.code);
  return codes;
}

TEST(Catalogues, AreThoseThatAreShipped) {
  EXPECT_EQ(shipped(), (std::vector<std::string>{"de", "el", "en", "es", "fr", "ko", "pt"}));
}

using Messages = std::vector<PoFile::Message>;

void expectHas(const Messages& its, const Messages& all, const std::string& where) {
  std::map<std::string, std::string> there;
  for (const PoFile::Message& one : its) there[one.id] = one.translation;
  std::size_t missing = 0;
  for (const PoFile::Message& one : all) {
    if (!there[one.id].empty()) continue;
    if (++missing < 5) ADD_FAILURE() << where << " lacks: " << one.id;
  }
  EXPECT_GT(all.size(), 100u) << where;
  EXPECT_EQ(missing, 0u) << where;
}

TEST(Catalogues, HaveEveryMessage) {
  const PoFile all = readPo(readWhole(kFolder / "palpa.pot").value(), "palpa.pot");
  for (const std::string& code : shipped()) {
    if (code == "en") continue;
    const PoFile its = readPo(readWhole(kFolder / (code + ".po")).value(), code);
    expectHas(its.messages, all.messages, code);
    expectHas(its.of_the_guide, all.of_the_guide, code + ", the guide's first chapter");
  }
}

TEST(Catalogues, SayThatNobodyHasReviewedThem) {
  for (const Language& one : languagesIn(kFolder)) {
    EXPECT_EQ(one.reviewed, one.code == "en") << one.code;
    EXPECT_FALSE(one.name.empty());
  }
}

TEST(Languages, AreChosenByOptionThenEnvironment) {
  EXPECT_EQ(wishedLanguage(kFolder, "el"), "el");
  const palpa::test::Setting none("LANGUAGE", ""), all("LC_ALL", ""), messages("LC_MESSAGES", "");
  {
    const palpa::test::Setting lang("LANG", "el_GR.UTF-8");
    EXPECT_EQ(wishedLanguage(kFolder, ""), "el");
  }
  const palpa::test::Setting lang("LANG", "C.UTF-8");
  EXPECT_EQ(wishedLanguage(kFolder, ""), "en");
  EXPECT_THROW(languageOf(kFolder, "xx"), UsageError);
}

TEST(Shelf, TakesWhatABrowserWishes) {
  const Shelf shelf(kFolder);
  EXPECT_EQ(shelf.best("el", "de"), "el");
  EXPECT_EQ(shelf.best("", "it, el-GR;q=0.8, en;q=0.5"), "el");
  EXPECT_EQ(shelf.best("../x", ",;, ;q=1"), "en");
}

TEST(Pseudo, MarksEveryLetterAndIsAThirdLonger) {
  const auto all = pseudoMessages({{}, {{"Depth of {1} mm", ""}}});
  EXPECT_EQ(all[0].translation.find('D'), std::string::npos);
  EXPECT_NE(all[0].translation.find("{1}"), std::string::npos);
}

/// The pages say the same as the program: one rule, written twice.
TEST(Pages, SayTheSameAsTheProgram) {
  if (std::system("node --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "node is not here";
  const palpa::test::ScratchFolder scratch("language");
  Shelf shelf(kFolder);
  const auto spoken = shelf.of(kPseudo);
  const nlohmann::json texts = nlohmann::json::parse(
      readWhole(std::filesystem::path(PALPA_SOURCE_DIR) / "tests/language/texts.json").value());
  nlohmann::json expected = nlohmann::json::array();
  for (const std::string text : texts) expected.push_back(spoken->book.said(text));
  writeWhole(scratch / "catalogue.json", shelf.catalogueJson(kPseudo));
  writeWhole(scratch / "expected.json", expected.dump());
  const std::string command = "node " PALPA_SOURCE_DIR "/tests/language/same.mjs " +
                              (scratch / "catalogue.json").string() + " " +
                              (scratch / "expected.json").string();
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST(Messages, AreThoseOfTheSources) {
  if (std::system("node --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "node is not here";
  EXPECT_EQ(std::system("node " PALPA_SOURCE_DIR "/cmake/words.mjs --check"), 0)
      << "node cmake/words.mjs writes the messages again; then tell the catalogues";
}

}  // namespace
}  // namespace palpa::language
