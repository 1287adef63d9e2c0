#include "apps/assess/competence/form.h"

#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "tests/competence/reference.h"

namespace palpa::competence::test {
namespace {

TEST(Forms, TheShippedOnesAreWhatTheySay) {
  const Checklist list = shippedChecklist();
  EXPECT_EQ(list.items.size(), 24u);
  EXPECT_EQ(
      std::count_if(list.items.begin(), list.items.end(), [](const Item& i) { return i.major; }),
      18);
  EXPECT_EQ(list.standards, (std::vector<double>{0.98, 0.90}));
  EXPECT_EQ(list.competent.major, 17);
  EXPECT_EQ(list.borderline.minor, 2);
  EXPECT_EQ(shippedGlobal().items.size(), 6u);
}

std::string refusal(const std::function<void()>& parse) {
  try {
    parse();
  } catch (const UsageError& e) {
    return e.what();
  }
  return "accepted";
}

/// The shipped list with one text replaced by another.
std::string spoilt(const std::string& what, const std::string& with) {
  std::string text = palpa::test::slurp(PALPA_SOURCE_DIR "/assets/checklists/subclavian.json");
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return refusal([&] { parseChecklist(text.replace(at, what.size(), with), "list.json"); });
}

TEST(Forms, DamagedFilesAreNamedWithTheirField) {
  EXPECT_NE(refusal([] { parseChecklist("{", "list.json"); }).find("list.json: is not JSON"),
            std::string::npos);
  EXPECT_NE(
      spoilt("\"version\": 1", "\"version\": 2").find("list.json, version: is of a newer program"),
      std::string::npos);
  EXPECT_NE(spoilt("\"metric\": \"error_site\"", "\"metric\": \"error_sight\"")
                .find("\"error_sight\" is no figure of a trial"),
            std::string::npos);
  EXPECT_NE(
      spoilt("\"id\": \"position\"", "\"id\": \"explained\"").find("\"explained\" is there twice"),
      std::string::npos);
  EXPECT_NE(spoilt("\"weight\": \"minor\"", "\"weight\": \"heavy\"").find("must be major or minor"),
            std::string::npos);
  EXPECT_NE(spoilt("\"judged_by\": \"rater\"", "\"judged_by\": \"nobody\"")
                .find("must be simulator or rater"),
            std::string::npos);
  EXPECT_NE(spoilt("\"share_pct\": 98", "\"share_pct\": 980").find("share_pct: is out of range"),
            std::string::npos);
  EXPECT_NE(spoilt("\"standards\"", "\"standard\"").find("standards: must be a list"),
            std::string::npos);
}

TEST(Answers, AreReadAsTheyAreTypedIn) {
  const Checklist list = shippedChecklist();
  const GlobalRating global = shippedGlobal();
  const FormAnswers a = parseAnswers(
      "item,value\r\nsterile,done\nposition, not done # lay on the side\n\"held\",did not "
      "arise\nexplained,\nplan,4\n\n",
      "a.csv", list, &global);
  EXPECT_EQ(a.checklist,
            (Answers{{"sterile", kDone}, {"position", kNotDone}, {"held", kDidNotArise}}));
  EXPECT_EQ(a.global, (Answers{{"plan", 4}}));
}

TEST(Answers, MistakesAreNamedWithTheirLine) {
  const Checklist list = shippedChecklist();
  const GlobalRating global = shippedGlobal();
  const auto refused = [&](const std::string& text) {
    return refusal([&] { parseAnswers(text, "a.csv", list, &global); });
  };
  EXPECT_NE(refused("sterile,done\nsteril,done").find("a.csv, line 2: names \"steril\""),
            std::string::npos);
  EXPECT_NE(refused("sterile,4").find("\"4\" is no answer to \"sterile\""), std::string::npos);
  EXPECT_NE(refused("plan,6").find("\"6\" is no answer to \"plan\""), std::string::npos);
  EXPECT_NE(refused("plan,4\nplan,5").find("answers \"plan\" again"), std::string::npos);
  EXPECT_NE(refused("sterile done").find("has no comma"), std::string::npos);
  EXPECT_NE(refusal([&] { parseAnswers("plan,4", "a.csv", list, nullptr); }).find("names \"plan\""),
            std::string::npos);
}

}  // namespace
}  // namespace palpa::competence::test
