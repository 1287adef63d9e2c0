#include "apps/calibrate/subtask_recordings.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/calibrate/a_calibration.h"
#include "tests/record/synthetic_session.h"
#include "tests/support/complaint.h"

/// Session files as sequences of labelled steps, and what is no such file.
namespace palpa::calibrate {
namespace {

using palpa::test::complaint, palpa::test::says;

constexpr const char* kSlowPart =
    R"({"name": "slow", "means": "hardly moving", "on": [{"cue": "speed", "below": 0.01}]})";
constexpr const char* kFastPart =
    R"({"name": "fast", "means": "moving", "on": [{"cue": "speed", "at_least": 0.01}]})";

std::string taskOf(const std::string& parts) {
  return R"({"version": 1, "id": "strokes", "hysteresis": 0.05, "subtasks": [)" + parts +
         R"(], "augmentations": [], "limit_share": 0.5})";
}

/// Two trials of 0.8 s, between them 0.2 s of none; the first part is on in the first half of each,
/// then the second. In the second trial the handle is held for 0.1 s, and cues are allowed.
std::filesystem::path recorded(const std::string& name, const std::string& task,
                               const std::string& session = R"({"simulated": true})") {
  const std::filesystem::path folder = palpa::test::freshFolder("calibrate", name);
  record::SessionInfo info = record::test::syntheticInfo();
  info.task_json = task;
  info.session_json = session;
  info.station_json = R"({"id": "bench-7"})";
  record::SessionWriter writer(folder / "session.palpa", info);
  for (int ms = 0; ms < 2000; ++ms) {
    if (ms % 1000 == 0)
      writer.beginTrial({ms / 1000 + 1, std::int64_t{ms} * 1'000'000, 5, "scored", true, 1.7});
    haptics::FlightRecord tick = record::test::syntheticTick(ms);
    const int in = ms % 1000;
    tick.commands.trial = in < 900 ? static_cast<std::uint32_t>(ms / 1000 + 1) : 0;
    tick.commands.held = ms >= 1000 && in < 100;
    tick.commands.augmented = ms >= 1000;
    tick.subtasks = in < 400 ? 1 : 2;
    writer.tick(tick);
    if (in == 850)
      writer.endTrial({ms / 1000 + 1, std::int64_t{ms} * 1'000'000 - 50'000'000, "success", "",
                       ""});  // judged until 0.8 s
  }
  writer.commit();
  writer.close();
  return folder / "session.palpa";
}

TEST(SubtaskRecordings, TrialsAreSequencesOfTheirOwn) {
  const std::string task = taskOf(std::string(kSlowPart) + ", " + kFastPart);
  const std::filesystem::path file = recorded("both", task);
  const SubtaskRecordings one = readSubtaskRecordings({file});
  EXPECT_EQ(one.task, "strokes");
  EXPECT_EQ(one.station, "bench-7");
  ASSERT_EQ(one.parts.size(), 2u);
  EXPECT_EQ(one.wordsOf(3), "slow + fast");
  EXPECT_EQ(one.wordsOf(0), "no part");
  EXPECT_TRUE(one.simulated);
  EXPECT_EQ(one.augmented, 1);
  EXPECT_EQ(one.left_out, 0);
  ASSERT_EQ(one.sequences.size(), 2u);
  EXPECT_EQ(one.sequences[1].trial, "trial 2");
  EXPECT_EQ(one.sequences[0].labels.size(), 80u);
  EXPECT_EQ(one.sequences[1].labels.size(), 70u);  // from when the handle is let go
  EXPECT_NEAR(one.sequences[1].begins_s, 1.1, 1e-9);
  for (std::size_t i = 0; i < 80; ++i) EXPECT_EQ(one.sequences[0].labels[i], i < 40 ? 1 : 2) << i;
  ASSERT_EQ(one.files.size(), 1u);
  EXPECT_EQ(one.files[0].sha256.size(), 64u);

  const std::filesystem::path more = recorded("real", task, R"({"simulated": false})");
  const SubtaskRecordings two =
      readSubtaskRecordings({more, file.parent_path()});  // a folder that holds one
  ASSERT_EQ(two.sequences.size(), 4u);
  EXPECT_EQ(two.sequences[0].trial, "real, trial 1");
  EXPECT_EQ(two.sequences[3].trial, "both, trial 2");
  EXPECT_TRUE(two.simulated);
  EXPECT_FALSE(readSubtaskRecordings({more}).simulated);
}

TEST(SubtaskRecordings, PartsMayBeNamedByATaskFileThatTellsThemAlike) {
  const std::filesystem::path file = recorded("renamed",
                                              taskOf(std::string(kSlowPart) + ", " + kFastPart)),
                              folder = file.parent_path();
  const auto written = [&](const std::string& name, const std::string& task) {
    std::ofstream(folder / name) << task;
    return folder / name;
  };
  const SubtaskRecordings named = readSubtaskRecordings(
      {file},
      written(
          "alike.json",
          taskOf(R"({"name": "creep", "means": "", "on": [{"cue": "speed", "below": 0.01}]}, )" +
                 std::string(kFastPart))));
  EXPECT_EQ(named.wordsOf(3), "creep + fast");
  EXPECT_TRUE(says(
      complaint([&] { readSubtaskRecordings({file}, written("other.json", taskOf(kFastPart))); }),
      "recognises its parts by other conditions than the task that was recorded"));
  EXPECT_TRUE(says(complaint([&] {
                     readSubtaskRecordings({file},
                                           written("none.json", R"({"version": 1, "id": "x"})"));
                   }),
                   "none.json: names no parts"));
  EXPECT_THROW(readSubtaskRecordings({file}, folder / "missing.json"), UsageError);
}

TEST(SubtaskRecordings, WhatIsNoSuchRecordingIsNamed) {
  const std::filesystem::path file = recorded("good", taskOf(kSlowPart)),
                              bare = recorded("bare", R"({"version": 1, "id": "hold"})"),
                              other = recorded("other", taskOf(kFastPart)),
                              damaged = recorded("damaged", "{");
  const auto complaintOf = [](const std::vector<std::filesystem::path>& files) {
    return complaint([&] { readSubtaskRecordings(files); });
  };
  EXPECT_TRUE(says(
      complaintOf({bare}),
      "its task \"hold\" names no parts (\"subtasks\"). Record a task whose file names its parts"))
      << complaintOf({bare});
  EXPECT_TRUE(
      says(complaintOf({file, other}), "its task recognises its parts by other conditions than"));
  EXPECT_TRUE(says(complaintOf({damaged}), "the description of its task is damaged"));
  const std::filesystem::path worded =
      recorded("worded", taskOf(kSlowPart), R"({"simulated": "yes"})");
  EXPECT_TRUE(
      says(complaintOf({worded}), "its session: field \"simulated\" must be true or false"));
  EXPECT_TRUE(says(complaintOf({file.parent_path() / "none.palpa"}), "no such file"));
  std::ofstream(file.parent_path() / "text.palpa") << "a text that is long enough to be looked at";
  EXPECT_TRUE(says(complaintOf({file.parent_path() / "text.palpa"}), "is not a session file"));
}

}  // namespace
}  // namespace palpa::calibrate
