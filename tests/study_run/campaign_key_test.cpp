#include <fstream>
#include <set>

#include "anatomy/base/whole_file.h"
#include "small_campaign.h"
#include "tests/support/counts.h"
#include "tests/support/setting.h"

/// A session's key changes with all that its result follows from, and with nothing else.
namespace palpa::study {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::vector<std::string> keysIn(const fs::path& file) { return keysOf(readCampaign(file)); }

/// How many of these keys are not among those.
std::size_t others(const std::vector<std::string>& keys, const std::vector<std::string>& among) {
  const std::set<std::string> known(among.begin(), among.end());
  std::size_t count = 0;
  for (const std::string& key : keys) count += !known.count(key);
  return count;
}

/// A campaign of two needle sessions with files of its own, as far as there are such files.
class Keys : public SmallCampaign {
 protected:
  Keys() {
    for (const char* name : {"tasks", "materials", "stations", "operators"})
      fs::copy(kAssets / name, here_ / name, fs::copy_options::recursive);
    put("patient.glb", {{"any", "bytes"}});
  }
  json needle() const {
    return {{"version", 1},
            {"id", "needle"},
            {"title", "Needle"},
            {"tasks", {"tasks/paracentesis.json"}},
            {"station", "stations/virtual_bench.json"},
            {"operators", {"operators/novice.json"}},
            {"patient_files", {"patient.glb"}},
            {"seeds", {{"from", 1}, {"count", 2}}}};
  }
  std::vector<std::string> keys(const json& change = json::object()) const {
    json campaign = needle();
    campaign.merge_patch(change);
    return keysIn(put("campaign.json", campaign));
  }
  void touch(const std::string& name) const { std::ofstream(here_ / name, std::ios::app) << "\n"; }
};

TEST_F(Keys, ChangeWithEveryFileThatASessionNamesAndNoOther) {
  const std::vector<std::string> before = keys();
  EXPECT_EQ(std::set<std::string>(before.begin(), before.end()).size(), 2u);
  EXPECT_EQ(before[0].size(), 64u);
  EXPECT_EQ(keys(), before);
  for (const char* other : {"tasks/bone_pin.json", "materials/bone_pin.json",
                            "operators/expert.json", "stations/search_bench.json"}) {
    touch(other);
    EXPECT_EQ(keys(), before) << other;
  }
  std::vector<std::string> seen = before;
  for (const char* named :
       {"tasks/paracentesis.json", "tasks/paracentesis_expert_path.json", "materials/needle.json",
        "stations/virtual_bench.json", "operators/novice.json", "patient.glb"}) {
    touch(named);
    const std::vector<std::string> now = keys();
    EXPECT_EQ(others(now, seen), 2u) << named;
    seen.insert(seen.end(), now.begin(), now.end());
  }
}

TEST_F(Keys, ChangeWithEveryFieldOfASetting) {
  const json schema = json::parse(slurped(kAssets / "schemas/campaign.schema.json"));
  const json& fields = schema["properties"]["settings"]["items"]["properties"];
  const json unusual{{"force_feedback", false}, {"augment", true},   {"assess", true},
                     {"knows_patient", true},   {"guidance", true},  {"handedness", "left"},
                     {"side", "left"},          {"mode", "all"},     {"presentation", "pilot"},
                     {"name", "another"},       {"about", "a word"}, {"tracking", "model"}};
  const std::set<std::string> of_no_weight{"name", "about"}, of_others{"guidance", "mode"};
  std::vector<std::string> seen = keys();
  for (const auto& field : fields.items()) {
    ASSERT_TRUE(unusual.contains(field.key())) << "which changes the key? " << field.key();
    json setting{{"name", "usual"}};
    setting[field.key()] = unusual[field.key()];
    if (of_others.count(field.key())) continue;  // below
    const std::vector<std::string> now = keys({{"settings", {setting}}});
    EXPECT_EQ(others(now, seen), of_no_weight.count(field.key()) ? 0u : 2u) << field.key();
    seen.insert(seen.end(), now.begin(), now.end());
  }
  const std::pair<const char*, const char*> elsewhere[]{{"tasks/palpation_breast.json", "guidance"},
                                                        {"tasks/search.json", "mode"}};
  for (const auto& [task, field] : elsewhere) {
    const json other{{"tasks", {task}}, {"patient_files", nullptr}, {"operators", {"expert"}}};
    json with = other;
    with["settings"] = {{{"name", "usual"}, {field, unusual[field]}}};
    EXPECT_EQ(others(keys(with), keys(other)), 2u) << field;
  }
}

TEST_F(Keys, ChangeWithPatientOperatorSeedAndTrials) {
  std::vector<std::string> seen = keys();
  for (const json& change : std::initializer_list<json>{
           {{"patient_files", nullptr}},
           {{"patient_files", nullptr}, {"patients", {{"from", 1}, {"count", 1}}}},
           {{"operators", {"expert"}}},
           {{"operators", {"novice"}}},
           {{"seeds", {{"from", 3}}}},
           {{"trials", 2}},
           {{"station", nullptr}}}) {
    const std::vector<std::string> now = keys(change);
    EXPECT_EQ(others(now, seen), 2u) << change;
    seen.insert(seen.end(), now.begin(), now.end());
  }
  EXPECT_EQ(others(keys({{"title", "Another"}, {"id", "another"}}), keys()), 0u);
  EXPECT_EQ(others(keys({{"seeds", {{"count", 3}}}}), keys()), 1u) << "one more";
}

/// Whatever does not change the keys is not needed: without it a session gives the same.
class OwnAssets : public SmallCampaign {
 protected:
  OwnAssets() : assets_(here_ / "assets"), setting_("PALPA_ASSETS", assets_.c_str()) {
    fs::copy(kAssets, assets_, fs::copy_options::recursive);
  }
  /// Takes away every file without which the keys stay what they are; how many that were.
  std::size_t takeAwayWhatDoesNotCount(const fs::path& file) const {
    const std::vector<std::string> before = keysIn(file);
    std::vector<fs::path> unused;
    for (const auto& entry : fs::recursive_directory_iterator(assets_)) {
      if (!entry.is_regular_file()) continue;
      const std::string bytes = slurped(entry.path());
      std::ofstream(entry.path(), std::ios::app) << "\n";
      if (keysIn(file) == before) unused.push_back(entry.path());
      std::ofstream(entry.path(), std::ios::binary) << bytes;
    }
    for (const fs::path& path : unused) fs::remove(path);
    return unused.size();
  }

  const fs::path assets_;
  const test::Setting setting_;
};

TEST_F(OwnAssets, ThatDoNotCountAreNotRead) {
  std::vector<std::pair<const char*, const char*>> sessions{
      {"friction", "palpation_bench"}, {"search", "search_bench"}, {"bone_pin", "virtual_bench"}};
  if (test::fullCounts())
    for (const char* task : {"squeeze", "pulse", "palpation_breast"})
      sessions.emplace_back(task, "palpation_bench");
  for (const auto& [task, bench] : sessions) {
    put("station.json",
        json::parse(slurped(kAssets / "stations" / (std::string(bench) + ".json"))));
    const fs::path file =
        put("campaign.json", {{"version", 1},
                              {"id", task},
                              {"title", task},
                              {"tasks", {std::string("assets/tasks/") + task + ".json"}},
                              {"station", "station.json"},
                              {"operators", {"expert"}},
                              {"settings", {{{"name", "usual"}, {"tracking", "model"}}}},
                              {"seeds", {{"from", 41}, {"count", 1}}}});
    const std::string out = task, bare = out + "-bare";
    ASSERT_EQ(Runner(options(file, out), here_ / (out + ".txt")).wait().failure, "") << task;
    EXPECT_GT(takeAwayWhatDoesNotCount(file), 30u) << task;
    const Ran without = Runner(options(file, bare), here_ / (bare + ".txt")).wait();
    EXPECT_EQ(without.failure, "") << without.printed;
    EXPECT_EQ(slurped(tableIn(bare)), slurped(tableIn(out))) << task;
    EXPECT_EQ(linesIn(slurped(tableIn(out))), 2u);
    fs::remove_all(assets_);
    fs::copy(kAssets, assets_, fs::copy_options::recursive);
  }
}

}  // namespace
}  // namespace palpa::study
