#include "apps/record/session_file.h"

#include <gtest/gtest.h>

#include <clocale>
#include <fstream>
#include <map>
#include <sstream>

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

TEST(TickExport, NumbersAreTheRecordedOnesToTheLastBit) {
  const fs::path folder = freshFolder("export");
  {
    SessionWriter writer(folder / "session.palpa", syntheticInfo());
    writeTrial(writer, 250);
  }
  exportTicks(SessionReader(folder / "session.palpa"), folder / "ticks.csv");
  std::ifstream csv(folder / "ticks.csv");
  std::string line;
  ASSERT_TRUE(std::getline(csv, line));
  const auto header = fields(line);
  const auto columns = tickColumns();
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
    EXPECT_EQ(row[at["events"]], tick % 16 == 0 ? "snapshot_adopted" : "");
  }
  EXPECT_EQ(tick, 250);
}

TEST(TickExport, LeavesNothingHalfWritten) {
  const fs::path folder = freshFolder("export_error");
  { SessionWriter writer(folder / "session.palpa", syntheticInfo()); }
  const SessionReader reader(folder / "session.palpa");
  EXPECT_THROW(exportTicks(reader, folder / "missing" / "ticks.csv"), Error);
  fs::create_directory(folder / "ticks.csv");  // a folder of that name cannot be replaced
  EXPECT_THROW(exportTicks(reader, folder / "ticks.csv"), Error);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 2) << "a part is left";
}

}  // namespace
}  // namespace palpa::record
