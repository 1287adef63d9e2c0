#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "asset_files.h"

/// Each field of each settings file in turn: taken away, of the wrong kind, out of all proportion.
namespace palpa::station {
namespace {

using nlohmann::json;
using Pointer = json::json_pointer;

/// Fields that only explain: nobody computes with them.
bool explains(const std::string& field) {
  for (const char* word : {"source", "about", "what", "unit", "reason", "title", "name", "/id",
                           "date", "description", "family", "/words/"})
    if (field.find(word) != std::string::npos) return true;
  return false;
}

std::vector<Pointer> leaves(const json& root) {
  std::vector<Pointer> all;
  const json flat = root.flatten();
  for (const auto& [pointer, value] : flat.items()) all.emplace_back(pointer);
  return all;
}

/// The field as messages write it: "skin/m_per_mm" for /skin/m_per_mm/value.
std::string fieldOf(const Pointer& leaf) {
  std::string field = leaf.to_string().substr(1);
  const std::size_t cut = std::min({field.find("/value"), field.find("/range"), field.find("/0"),
                                    field.find("/1"), field.find("/2")});
  return field.substr(0, cut);
}

void remove(json& root, const Pointer& leaf) {
  json& parent = root.at(leaf.parent_pointer());
  if (parent.is_array())
    parent.erase(std::stoul(leaf.back()));
  else
    parent.erase(leaf.back());
}

class Fields : public testing::TestWithParam<AssetFile> {
 protected:
  const AssetFile& asset() const { return GetParam(); }
  Verdict with(const Pointer& leaf, const json& value) const {
    json changed = asset().json();
    changed.at(leaf) = value;
    return judge(asset(), changed.dump());
  }
  /// Refused, in words that name the file and, where they come from JsonFile, the field.
  void expectRefused(const Verdict& verdict, const Pointer& leaf, const std::string& how) const {
    EXPECT_FALSE(verdict.valid) << leaf.to_string() << " " << how << " was taken for valid";
    if (verdict.valid) return;
    EXPECT_NE(verdict.message.find("palpa-station-"), std::string::npos) << verdict.message;
    EXPECT_EQ(verdict.message.find('\n'), std::string::npos) << verdict.message;
    if (!asset().is_json_file) return;
    EXPECT_TRUE(verdict.usage_error) << verdict.message;
    const std::string last = fieldOf(leaf).substr(fieldOf(leaf).rfind('/') + 1);
    EXPECT_NE(verdict.message.find(last), std::string::npos)
        << leaf.to_string() << ": " << verdict.message;
  }
};

TEST_P(Fields, ShippedFileLoads) {
  const Verdict verdict = judge(asset(), asset().text());
  EXPECT_TRUE(verdict.valid) << verdict.message;
  EXPECT_NO_THROW(asset().read(asset().path()));
}

TEST_P(Fields, TakenAwayIsToldOrWasNotNeeded) {
  std::set<std::string> not_needed;
  int refused = 0;
  for (const Pointer& leaf : leaves(asset().json())) {
    json changed = asset().json();
    remove(changed, leaf);
    const Verdict verdict = judge(asset(), changed.dump());
    if (verdict.valid)
      not_needed.insert(leaf.to_string());
    else
      ++refused, expectRefused(verdict, leaf, "taken away");
  }
  EXPECT_GT(refused, 3);
  // What may be missing is what only explains, or what has a place of its own to be checked (the
  // twin's truth is read by the virtual bench; a range is a second guard beside the program's own).
  for (const std::string& field : not_needed)
    EXPECT_TRUE(explains(field) || field.rfind("/twin", 0) == 0 ||
                field.find("/range") != std::string::npos ||
                field == "/device/continuous_force_N" || field == "/device/plunger_button" ||
                field == "/brief" || !asset().is_json_file)
        << field << " is not needed?";
}

TEST_P(Fields, NumberAsTextOrNullIsRefused) {
  for (const Pointer& leaf : leaves(asset().json())) {
    const std::string field = leaf.to_string();
    if (!asset().json().at(leaf).is_number() || field.rfind("/twin", 0) == 0) continue;
    for (const json& wrong : {json("much"), json(nullptr), json::array(), json(true)})
      if (asset().is_json_file || wrong.is_string())
        expectRefused(with(leaf, wrong), leaf, "as " + wrong.dump());
  }
}

TEST_P(Fields, NumberOutOfAllProportionIsRefused) {
  for (const Pointer& leaf : leaves(asset().json())) {
    const std::string field = leaf.to_string();
    if (!asset().is_json_file || !asset().json().at(leaf).is_number()) continue;
    if (field.rfind("/twin", 0) == 0 || field.find("/range") != std::string::npos) continue;
    if (field.find("position_mm") != std::string::npos ||
        field.find("rotation_vector") != std::string::npos ||
        field.find("entry_mm") != std::string::npos ||
        field.find("aim_offset") != std::string::npos)
      continue;  // a place in a room has no natural limit
    expectRefused(with(leaf, 1e12), leaf, "at 1e12");
    expectRefused(with(leaf, -1e12), leaf, "at -1e12");
  }
}

class Versions : public Fields {};

TEST_P(Versions, LaterVersionIsRefused) {
  const Pointer version("/version");
  expectRefused(with(version, 2), version, "of a later program");
  expectRefused(with(version, 0), version, "before the first");
  expectRefused(with(version, 1.5), version, "between two");
}

std::vector<AssetFile> filesWithVersion() {
  std::vector<AssetFile> files = assetFiles();
  std::erase_if(files, [](const AssetFile& asset) { return !asset.is_json_file; });
  return files;
}

INSTANTIATE_TEST_SUITE_P(Assets, Versions, testing::ValuesIn(filesWithVersion()),
                         [](const auto& asset) { return testName(asset.param); });
INSTANTIATE_TEST_SUITE_P(Assets, Fields, testing::ValuesIn(assetFiles()),
                         [](const auto& asset) { return testName(asset.param); });

TEST(NeedleFile, EveryTissueAndWallIsNeeded) {
  const AssetFile needle = assetFiles()[1];
  for (const char* group : {"layers", "walls"}) {
    const json parts = needle.json().at(group);
    for (const auto& [part, ignored] : parts.items()) {
      json changed = needle.json();
      changed[group].erase(part);
      const Verdict verdict = judge(needle, changed.dump());
      EXPECT_TRUE(verdict.usage_error) << part << " may be missing?";
      EXPECT_NE(verdict.message.find(part), std::string::npos) << verdict.message;
    }
    json more = needle.json();
    more[group]["spleen"] = parts.begin().value();
    EXPECT_NE(judge(needle, more.dump()).message.find("spleen"), std::string::npos);
  }
}

TEST(StationFile, ABoardThatCannotBeSeenIsRefused) {
  const AssetFile station = assetFiles()[0];
  json narrow = station.json();
  narrow["board"]["spacing_mm"] = 1;  // the detector needs an eighth of the tag: 3.75 mm
  EXPECT_TRUE(judge(station, narrow.dump()).usage_error);
  json beyond = station.json();
  beyond["board"]["first_id"] = 580;  // 24 tags, ids 580 to 603; the family ends at 586
  EXPECT_TRUE(judge(station, beyond.dump()).usage_error);
}

TEST(StationFile, LimitsFollowTheDevice) {
  const AssetFile station = assetFiles()[0];
  json strong = station.json();
  strong["safety"]["max_force_N"] = 8.0;  // the device gives 7.9
  EXPECT_TRUE(judge(station, strong.dump()).usage_error);
  json stiff = station.json();
  stiff["coupling"]["stiffness_N_per_m"] = 1001;  // stable to 1000
  EXPECT_TRUE(judge(station, stiff.dump()).usage_error);
}

}  // namespace
}  // namespace palpa::station
