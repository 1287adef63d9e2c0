#include "apps/study/questionnaire.h"

#include "small_protocol.h"

namespace palpa::study {
namespace {

using nlohmann::json;

std::string complaintAbout(const std::function<void(json&)>& change) {
  json q = smallQuestionnaire();
  change(q);
  const auto file = written(smallProtocol(), q).parent_path() / "questions.json";
  std::string complaint = complaintOf([&] { readQuestionnaire(file); });
  EXPECT_NE(complaint.find(file.string()), std::string::npos) << complaint;
  return complaint;
}

bool has(const std::string& text, const char* words) {
  return text.find(words) != std::string::npos;
}

TEST(Questionnaire, SaysWhatIsWrong) {
  EXPECT_TRUE(has(complaintAbout([](json& q) { q["version"] = 9; }), "newer"));
  EXPECT_TRUE(
      has(complaintAbout([](json& q) { q["items"] = json::array(); }), "at least one item"));
  EXPECT_TRUE(has(complaintAbout([](json& q) { q["items"][1]["id"] = "useful"; }),
                  "which another item has, too"));
  EXPECT_TRUE(
      has(complaintAbout([](json& q) { q["items"][0]["kind"] = "stars"; }), "likert or text"));
  EXPECT_TRUE(has(complaintAbout([](json& q) { q["items"][0]["points"] = 1; }), "\"points\" is 1"));
  EXPECT_TRUE(
      has(complaintAbout([](json& q) { q["items"][0].erase("low"); }), "\"low\" is missing"));
  EXPECT_TRUE(
      has(complaintAbout([](json& q) { q["items"][1]["may_be_left"] = 1; }), "true or false"));
}

TEST(Questionnaire, ChecksAnswers) {
  const Questionnaire q =
      readQuestionnaire(written(smallProtocol()).parent_path() / "questions.json");
  for (const char* good : {"1", "3", "5"}) EXPECT_EQ(whyNoAnswer(q.items[0], good), "") << good;
  for (const char* bad : {"", "0", "6", "4.5", "-1", "five", "1 ", "100000000000000000000"})
    EXPECT_NE(whyNoAnswer(q.items[0], bad), "") << bad;
  EXPECT_EQ(whyNoAnswer(q.items[1], ""), "");
  EXPECT_EQ(whyNoAnswer(q.items[1], "It's fine: ü"), "");
  EXPECT_NE(whyNoAnswer(q.items[1], std::string(2001, 'x')), "");
}

TEST(Questionnaire, TheShippedOnesAreReadable) {
  for (const auto& entry :
       std::filesystem::directory_iterator(PALPA_SOURCE_DIR "/assets/protocols/questionnaires"))
    EXPECT_GE(readQuestionnaire(entry.path()).items.size(), 5u) << entry.path();
}

}  // namespace
}  // namespace palpa::study
