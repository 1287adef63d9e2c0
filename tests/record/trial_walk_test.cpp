#include "apps/record/session_file.h"

#include <gtest/gtest.h>

#include "synthetic_session.h"

namespace palpa::record {
namespace {

using namespace test;

constexpr std::int64_t kMillisecond = 1'000'000;

/// A session of these trials whose ticks bear these numbers, one a millisecond.
std::filesystem::path recorded(
    const std::string& name,
    const std::vector<std::pair<runtime::TrialHeader, std::int64_t>>& trials_with_end_ms,
    const std::vector<std::uint32_t>& numbers) {
  std::filesystem::path file = freshFolder(name) / "session.palpa";
  SessionWriter writer(file, syntheticInfo());
  for (const auto& [header, end_ms] : trials_with_end_ms) {
    writer.beginTrial(header);
    if (end_ms >= 0) writer.endTrial({header.trial, end_ms * kMillisecond, "success", "", ""});
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    haptics::FlightRecord tick = syntheticTick(static_cast<std::int64_t>(i));
    tick.commands.trial = numbers[i];
    writer.tick(tick);
  }
  writer.close();
  return file;
}

/// What a walk calls: "<1" as trial 1 begins, the numbers of its ticks, ">" as it finishes.
std::string walked(const std::filesystem::path& file) {
  const SessionReader reader(file);
  std::string calls;
  walkTrials(
      reader, reader.trials(),
      {.begin = [&](const RecordedTrial& t) { calls += "<" + std::to_string(t.header.trial); },
       .tick = [&](const haptics::FlightRecord& r) { calls += " " + std::to_string(r.tick); },
       .finish = [&](const RecordedTrial&) { calls += ">"; }});
  return calls;
}

runtime::TrialHeader trial(int number) { return {number, 0, 1, "scored", true, 1.7}; }

TEST(TrialWalk, EachTrialGetsItsTicksUpToItsEnd) {
  // Tick 2 comes after the first trial's end, which is at 1 ms.
  const auto file = recorded("walk", {{trial(1), 1}, {trial(2), 9}}, {1, 1, 1, 2, 2});
  EXPECT_EQ(walked(file), "<1 0 1><2 3 4>");
}

TEST(TrialWalk, TicksBeforeATrialGoWithIt) {
  const auto file = recorded("walk_before", {{trial(1), 9}}, {0, 0, 1});
  EXPECT_EQ(walked(file), "<1 0 1 2>");
}

TEST(TrialWalk, TrialsWithoutTicksAreBegunAndFinished) {
  const auto file = recorded(
      "walk_empty", {{trial(1), 0}, {trial(2), 0}, {trial(4), -1}, {trial(5), -1}}, {4, 4});
  EXPECT_EQ(walked(file), "<1><2><4 0 1><5>");
  EXPECT_EQ(walked(recorded("walk_none", {}, {1, 2})), "");
}

TEST(TrialWalk, ATrialThatTheProcessStoppedInIsNeverOver) {
  RecordedTrial one{trial(1), {}, false};
  EXPECT_FALSE(one.isOver(INT64_MAX));
  one.ended = true;
  one.end.t_ns = 5;
  EXPECT_FALSE(one.isOver(5));
  EXPECT_TRUE(one.isOver(6));
}

}  // namespace
}  // namespace palpa::record
