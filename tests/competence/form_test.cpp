#include "apps/assess/competence/form.h"

#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "tests/competence/reference.h"

namespace palpa::competence::test {
namespace {

TEST(Forms, TheShippedOnesAreWhatTheySay) {
  const Checklist list = shippedChecklist();
  EXPECT_EQ(list.items.size(), 25u);
  EXPECT_EQ(std::count_if(list.items.begin(), list.items.end(),
                          [](const ChecklistItem& i) { return i.major; }),
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
  EXPECT_NE(refusal([] { parseChecklist("{", "list.json"); }).find("list.json: is not valid JSON"),
            std::string::npos);
  const std::pair<std::pair<const char*, const char*>, const char*> spoilt_texts[] = {
      {{"\"version\": 1", "\"version\": 2"}, "list.json: field \"version\" is newer"},
      {{"\"metric\": \"error_site\"", "\"metric\": \"error_sight\""},
       "field \"metric\" is \"error_sight\", which is not a figure of a trial"},
      {{"\"id\": \"position\"", "\"id\": \"explained\""},
       "list.json, \"items\", entry 2: field \"id\" is \"explained\", which occurs twice"},
      {{"\"weight\": \"minor\"", "\"weight\": \"heavy\""},
       "is \"heavy\"; it must be \"major\" or \"minor\""},
      {{"\"judged_by\": \"rater\"", "\"judged_by\": \"nobody\""},
       "is \"nobody\"; it must be \"rater\" or \"simulator\""},
      {{"\"share_pct\": 98", "\"share_pct\": 980"}, "field \"share_pct\" is 980, outside 1 to 100"},
      {{"\"standards\"", "\"standard\""},
       "field \"standard\" is unknown (did you mean \"standards\"?)"},
      {{"\"source\": \"Items", "\"sauce\": \"Items"},
       "field \"sauce\" is unknown (did you mean \"source\"?)"},
      {{"\"major\": 17", "\"major\": -17"}, "field \"levels/competent/major\" is -17, outside"}};
  for (const auto& [change, words] : spoilt_texts) {
    const std::string said = spoilt(change.first, change.second);
    EXPECT_NE(said.find(words), std::string::npos) << said;
    EXPECT_NE(said.find("assets/checklists"), std::string::npos) << said;
  }
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
  EXPECT_NE(refused("sterile,4").find("\"4\" is not an answer to \"sterile\""), std::string::npos);
  EXPECT_NE(refused("plan,6").find("\"6\" is not an answer to \"plan\""), std::string::npos);
  EXPECT_NE(refused("plan,4\nplan,5").find("answers \"plan\" again"), std::string::npos);
  EXPECT_NE(refused("sterile done").find("has no comma"), std::string::npos);
  EXPECT_NE(refusal([&] { parseAnswers("plan,4", "a.csv", list, nullptr); }).find("names \"plan\""),
            std::string::npos);
}

}  // namespace
}  // namespace palpa::competence::test
