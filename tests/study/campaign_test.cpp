#include "apps/study/campaign.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "anatomy/base/error.h"
#include "tests/support/files.h"

namespace palpa::study {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

const fs::path kAssets = fs::path(PALPA_SOURCE_DIR) / "assets";

json smallCampaign() {
  return {{"version", 1},
          {"id", "small"},
          {"title", "Small"},
          {"tasks", {(kAssets / "tasks/paracentesis.json").string()}},
          {"operators", {"expert", "novice"}},
          {"patients", {{"from", 0}, {"count", 3}}},
          {"seeds", {{"from", 10}, {"count", 4}}},
          {"trials", 5},
          {"settings", {{{"name", "touch"}}, {{"name", "no_touch"}, {"force_feedback", false}}}}};
}

fs::path writtenCampaign(const json& campaign) {
  fs::path file = test::freshFolder("study", "campaign") / "campaign.json";
  std::ofstream(file) << campaign.dump();
  return file;
}

/// What the program says against it; empty: nothing.
std::string faultOf(const json& campaign) {
  try {
    readCampaign(writtenCampaign(campaign));
    return "";
  } catch (const UsageError& e) {
    return e.what();
  }
}

std::string faultWith(const json& change) {
  json campaign = smallCampaign();
  campaign.merge_patch(change);
  return faultOf(campaign);
}

TEST(Campaign, HoldsEachCombinationOnceAndNoTwoOfThemShareATrialsSeed) {
  const Campaign c = readCampaign(writtenCampaign(smallCampaign()));
  EXPECT_EQ(c.sessions(), 2u * 3u * 4u * 2u);
  EXPECT_EQ(sizeInWords(c),
            "3 patients x 2 operators x 2 settings x 4 seeds = 48 sessions of 5 trials each");
  std::set<std::tuple<std::size_t, std::size_t, std::size_t, std::uint64_t>> seen;
  for (std::size_t n = 0; n < c.sessions(); ++n) {
    const CampaignSession s = sessionOf(c, n);
    EXPECT_LT(s.patient, 3u);
    EXPECT_LT(s.who, 2u);
    EXPECT_LT(s.setting, 2u);
    EXPECT_EQ(s.task, 0u);
    EXPECT_EQ((s.seed - 10) % 5, 0u);
    seen.insert({s.patient, s.who, s.setting, s.seed});
  }
  EXPECT_EQ(seen.size(), c.sessions());
  EXPECT_EQ(sessionOf(c, 1).seed, 15u) << "seeds change first";
  EXPECT_EQ(sessionOf(c, 4).setting, 1u);
  EXPECT_EQ(sessionOf(c, 8).who, 1u);
  EXPECT_EQ(sessionOf(c, 16).patient, 1u);
}

TEST(Campaign, NamesItsPatientsAndReadsItsSettings) {
  const Campaign c = readCampaign(writtenCampaign(smallCampaign()));
  EXPECT_EQ(c.patients[0].name, "reference");
  EXPECT_EQ(c.patients[2].name, "seed 2");
  EXPECT_TRUE(c.settings[0].force_feedback);
  EXPECT_FALSE(c.settings[1].force_feedback);
  json plain = smallCampaign();
  for (const char* field : {"patients", "settings", "trials"}) plain.erase(field);
  const Campaign least = readCampaign(writtenCampaign(plain));
  ASSERT_EQ(least.settings.size(), 1u);
  EXPECT_EQ(least.settings[0].name, "usual");
  ASSERT_EQ(least.patients.size(), 1u);
  EXPECT_EQ(least.patients[0].name, "reference");
  EXPECT_EQ(least.trials, 1);
}

TEST(Campaign, RefusesWhatItCannotHold) {
  const std::string palpation = (kAssets / "tasks/palpation_breast.json").string(),
                    needle = (kAssets / "tasks/paracentesis.json").string(),
                    reference = (kAssets / "patients/reference.json").string();
  const std::pair<json, const char*> cases[]{
      {{{"tasks", {needle, palpation}}}, "are of different engines: needle and palpation"},
      {{{"tasks", {needle, needle}}}, "has two files named \"paracentesis\""},
      {{{"tasks", {"none.json"}}}, "names \"none.json\", which is not there"},
      {{{"operators", {"expert", "expert"}}}, "has \"expert\" more than once"},
      {{{"operators", {"surgeon"}}}, "names \"surgeon\", which is not there"},
      {{{"operators", json::array()}}, "is empty"},
      {{{"seeds", {{"count", 8334}}}}, "a campaign has at most 100,000"},
      {{{"tasks", {palpation}}}, "has a meaning for needle tasks alone"},
      {{{"settings", {{{"name", "a"}, {"mode", "all"}}}}}, "has no meaning for tasks"},
      {{{"settings", {{{"name", "a"}}, {{"name", "a"}}}}}, "is another setting's, too"},
      {{{"settings", {{{"name", "a"}, {"side", "both"}}}}}, "must be left or right"},
      {{{"settings", {{{"name", "a"}, {"tracking", "film"}}}}}, "must be images or model"},
      {{{"patient_files", {needle, needle}}}, "has a second patient named \"paracentesis\""},
      {{{"patients", {{"from", 0}, {"count", 1}}}, {"patient_files", {reference}}},
       "has a second patient named \"reference\""},
      {{{"seeds", {{"form", 1}}}}, "did you mean \"from\"?"}};
  EXPECT_EQ(faultWith(json::object()), "");
  EXPECT_EQ(faultWith({{"seeds", {{"count", 8333}}}}), "") << "99,996 sessions";
  for (const auto& [change, words] : cases) {
    const std::string fault = faultWith(change);
    EXPECT_NE(fault.find(words), std::string::npos) << change << ": " << fault;
    EXPECT_NE(fault.find("campaign.json"), std::string::npos) << fault;
  }
}

TEST(Campaign, OfOperatorsOfOnesOwnKnowsThemByTheirFiles) {
  json campaign = smallCampaign();
  campaign["operators"] = {(kAssets / "operators/novice.json").string(), "expert"};
  const Campaign c = readCampaign(writtenCampaign(campaign));
  EXPECT_EQ(c.operators[0].name, "novice");
  EXPECT_EQ(c.operators[0].file, kAssets / "operators/novice.json");
  EXPECT_TRUE(c.operators[1].file.empty());
  campaign["operators"][1] = "novice";
  EXPECT_NE(faultOf(campaign).find("more than once"), std::string::npos);
}

}  // namespace
}  // namespace palpa::study
