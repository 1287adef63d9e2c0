#include "apps/bench/room/room_tally.h"

#include <gtest/gtest.h>

#include <fstream>

#include "apps/record/session_file.h"
#include "tests/support/scratch_folder.h"

/// Who judges a room counts what is planted.
namespace palpa::bench {
namespace {

std::vector<ToldEvent> events(const std::vector<std::int64_t>& numbers) {
  std::vector<ToldEvent> all;
  for (const std::int64_t n : numbers) all.push_back({n, 0.5 * static_cast<double>(n), "phase"});
  return all;
}

RoomTally tallyOf(const std::vector<ToldEvent>& recorded, const std::vector<ToldEvent>& arrived) {
  RoomTally tally;
  add({{"r", recorded}}, {{"r", arrived}}, &tally);
  return tally;
}

TEST(RoomTally, AllOnceAndInOrderIsAllThereIs) {
  const RoomTally tally = tallyOf(events({0, 1, 2}), events({0, 1, 2}));
  EXPECT_EQ(tally.recorded, 3);
  EXPECT_EQ(tally.arrived, 3);
  EXPECT_EQ(tally.records, 1);
  EXPECT_EQ(tally.missing + tally.doubled + tally.disordered + tally.changed + tally.beyond, 0);
}

TEST(RoomTally, EveryFaultIsCountedAsWhatItIs) {
  EXPECT_EQ(tallyOf(events({0, 1, 2}), events({0, 2})).missing, 1);
  EXPECT_EQ(tallyOf(events({0, 1, 2}), {}).missing, 3);
  EXPECT_EQ(tallyOf(events({0, 1, 2}), events({0, 1, 2, 2})).doubled, 1);
  EXPECT_EQ(tallyOf(events({0, 1, 2}), events({0, 2, 1})).disordered, 1);
  EXPECT_EQ(tallyOf(events({0, 1}), events({0, 1, 2})).beyond, 1);
  std::vector<ToldEvent> other = events({0, 1});
  other[1].event = "end";
  EXPECT_EQ(tallyOf(events({0, 1}), other).changed, 1);
  EXPECT_EQ(tallyOf(events({0, 1}), other).arrived, 1);
  other[1] = {1, 0.501, "phase"};
  EXPECT_EQ(tallyOf(events({0, 1}), other).changed, 1) << "another time";
}

TEST(RoomTally, WhatIsOfNoRecordIsBeyondAll) {
  RoomTally tally;
  add({{"r", events({0})}}, {{"r", events({0})}, {"s", events({0, 1})}}, &tally);
  EXPECT_EQ(tally.beyond, 2);
  EXPECT_EQ(tally.arrived, 1);
}

TEST(RoomTally, RecordsAndPagesAreReadAsTheyAreWritten) {
  const palpa::test::ScratchFolder folder("tally");
  std::filesystem::create_directories(folder / "sessions/a");
  std::filesystem::create_directories(folder / "sessions/cut");
  std::ofstream(folder / "sessions/cut/session.palpa") << "SQLite";
  record::SessionInfo info;
  info.session_json = info.station_json = info.task_json = "{}";
  info.uuid = "record-a";
  record::SessionWriter writer(folder / "sessions/a/session.palpa", info);
  writer.event({1'000'000'000, 1, nameOf(runtime::EventKind::start), "Trial 1 starts", 0});
  writer.event({1'500'000'000, 1, nameOf(runtime::EventKind::trial_case), "not told", 0});
  writer.event({2'000'400'000, 1, nameOf(runtime::EventKind::vein), "In the vein", 0});
  writer.close();
  std::int64_t cut_off = 0;
  const ByRecord recorded = recordedIn(folder.path(), &cut_off);
  EXPECT_EQ(cut_off, 1);
  ASSERT_EQ(recorded.at("record-a").size(), 2u);
  EXPECT_EQ(recorded.at("record-a")[1].t_s, 2.0);

  const auto line = [](const char* station, const char* number, const char* event) {
    return std::string(R"({"station":")") + station +
           R"(","event":{"record":"record-a","number":)" + number + R"(,"t_s":)" +
           (std::string(number) == "0" ? "1.0" : "2.0") + R"(,"event":")" + event + "\"}}\n";
  };
  std::ofstream(folder / "events-before.jsonl") << line("one", "0", "start");
  std::ofstream(folder / "events.jsonl") << R"({"station":"one","heard":{}})"
                                         << "\n"
                                         << line("two", "7", "vein") << "{\"stat\n"
                                         << line("one", "1", "vein");
  RoomTally tally;
  add(recorded, arrivedFrom("one", folder.path()), &tally);
  EXPECT_EQ(tally.arrived, 2);
  EXPECT_EQ(tally.missing + tally.doubled + tally.disordered + tally.changed + tally.beyond, 0);
}

}  // namespace
}  // namespace palpa::bench
