#include "apps/record/session_file.h"

#include <gtest/gtest.h>

#include <clocale>
#include <fstream>
#include <map>
#include <sstream>

#include <nlohmann/json.hpp>

#include "synthetic_session.h"

namespace palpa::record {
namespace {

using namespace test;
namespace fs = std::filesystem;

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> parts;
  std::stringstream stream(line + ',');
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

/// As recorded; of every odd tick is said what its force is made of.
TickSource allOf(const SessionReader& reader) {
  return [&reader](const VisitTick& visit) {
    reader.ticks([&](const haptics::FlightRecord& tick) {
      haptics::TickForces forces;
      forces.body = unpack(tick.f_contact_D);
      forces.rendered = 0.5;
      visit(tick, tick.tick % 2 ? &forces : nullptr);
    });
  };
}

TEST(TickExport, NumbersAreTheRecordedOnesToTheLastBit) {
  const fs::path folder = freshFolder("export");
  {
    SessionWriter writer(folder / "session.palpa", syntheticInfo());
    writeTrial(writer, 250);
  }
  const SessionReader reader(folder / "session.palpa");
  exportTicks(reader, allOf(reader), folder / "ticks.csv");
  std::ifstream csv(folder / "ticks.csv");
  std::string line;
  ASSERT_TRUE(std::getline(csv, line));
  const auto header = fields(line);
  const auto columns = tickColumns(reader.info());
  ASSERT_EQ(header.size(), columns.size());
  std::map<std::string, std::size_t> at;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    EXPECT_EQ(header[i], columns[i].name);
    EXPECT_FALSE(columns[i].meaning.empty());
    at[columns[i].name] = i;
  }
  EXPECT_EQ(at.size(), columns.size()) << "a name stands there twice";
  std::int64_t tick = 0;
  for (; std::getline(csv, line); ++tick) {
    const auto row = fields(line);
    const auto truth = syntheticTick(tick);
    ASSERT_EQ(row.size(), header.size());
    EXPECT_EQ(row[at["tick"]], std::to_string(tick));
    EXPECT_EQ(std::strtod(row[at["p_DE_y_m"]].c_str(), nullptr), truth.reading.p_DE[1]);
    EXPECT_EQ(std::strtod(row[at["f_command_D_z_N"]].c_str(), nullptr), truth.f_command_D[2]);
    EXPECT_EQ(row[at["phase"]], "indenting");
    EXPECT_EQ(row[at["tissue"]], "fat");
    EXPECT_EQ(row[at["safety"]], "none");
    EXPECT_EQ(row[at["rendered"]], tick % 2 ? "0.5" : "");
    EXPECT_EQ(row[at["f_body_D_z_N"]], tick % 2 ? row[at["f_contact_D_z_N"]] : "");
    EXPECT_EQ(row[at["events"]], tick % 16 == 0 ? "snapshot_adopted" : "");
  }
  EXPECT_EQ(tick, 250);
}

TEST(TickExport, LeavesNothingHalfWritten) {
  const fs::path folder = freshFolder("export_error");
  { SessionWriter writer(folder / "session.palpa", syntheticInfo()); }
  const SessionReader reader(folder / "session.palpa");
  EXPECT_THROW(exportTicks(reader, allOf(reader), folder / "missing" / "ticks.csv"), Error);
  fs::create_directory(folder / "ticks.csv");  // a folder of that name cannot be replaced
  EXPECT_THROW(exportTicks(reader, allOf(reader), folder / "ticks.csv"), Error);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 2) << "a part is left";
}

/// The columns of a session are those of its contact and its task's cues, and the laws name them.
TEST(TickExport, SaysTheForcesOfItsKindOfContactAndEachCueByName) {
  SessionInfo info = syntheticInfo();
  info.task_json = R"({"engine": "palpation",
    "subtasks": [{"name": "press", "means": "pressing"}],
    "augmentations": [{"name": "edge", "means": "a tap at a lump's edge"}, {"name": "firmer"}]})";
  haptics::TickConfig& config = info.tick_config;
  config.contact_mode = haptics::ContactMode::sensed_object;
  config.touch.other_friction = 1;
  config.touch.texture.speeds = config.touch.texture.forces = config.touch.texture.order = 1;
  config.augmentations.subtasks.count = 1;
  config.augmentations.count = 2;
  config.augmentations.each[0].kind = haptics::AugmentationKind::pulse;
  config.augmentations.each[0].subtask = 0;
  const fs::path folder = freshFolder("export_cues");
  { SessionWriter writer(folder / "session.palpa", info); }
  const SessionReader reader(folder / "session.palpa");
  const auto laws = nlohmann::json::parse(lawsJson(reader));
  std::map<std::string, std::string> meanings;
  for (const TickColumn& column : tickColumns(reader.info()))
    meanings[column.name] = column.meaning;
  for (const auto& [sum, parts] : laws.at("adds_up").items()) {
    EXPECT_TRUE(meanings.count(sum + "_x_N")) << sum;
    for (const auto& part : parts)
      EXPECT_TRUE(meanings.count(part.get<std::string>() + "_z_N")) << part;
  }
  EXPECT_EQ(meanings.count("f_body_D_x_N") + meanings.count("f_weight_D_x_N") +
                meanings.count("on_floor_x_U") + meanings.count("f_lumps_D_x_N"),
            0u);
  EXPECT_EQ(meanings.at("f_cue_1_D_x_N"), "added: the cue edge, a tap at a lump's edge");
  EXPECT_EQ(meanings.at("cues"),
            "bits of the task's augmentations that add force: 1 edge, 2 firmer");
  EXPECT_EQ(laws.at("cues").at(0).at("kind"), "pulse");
  EXPECT_EQ(laws.at("cues").at(0).at("part"), 0);
  EXPECT_FALSE(laws.at("cues").at(1).contains("part")) << "it belongs to no part";
  EXPECT_EQ(laws.at("surface").at("texture").at("nodes").size(), 1u);
  EXPECT_TRUE(laws.at("surface").contains("wanted_friction"));
}

}  // namespace
}  // namespace palpa::record
