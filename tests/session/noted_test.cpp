#include <gtest/gtest.h>

#include <vector>

#include "apps/evidence/told_events.h"
#include "apps/record/session_file.h"
#include "apps/trial/trial_status.h"
#include "tests/session/quick_sessions.h"

/// What somebody notes while a session runs stands with the moment that it is about.
namespace palpa::session {
namespace {

struct Note {
  double said_s = 0, about_s = 0;  ///< session time
  std::string text;
};

struct Held {
  std::vector<record::RecordedTrial> trials;
  report::SessionPage noted;
  std::vector<std::pair<double, double>> armed_s;  ///< of each trial the first armed tick, the last
};

/// Session times at which the trials' own time began and ended, s.
std::vector<std::pair<double, double>> armedIn(const record::SessionReader& evidence) {
  std::vector<std::pair<double, double>> armed;
  evidence.ticks([&](const haptics::FlightRecord& record) {
    if (!record.commands.armed) return;
    const double t_s = 1e-9 * static_cast<double>(record.t_ns);
    if (record.commands.trial > armed.size()) armed.emplace_back(t_s, t_s);
    armed.back().second = t_s;
  });
  return armed;
}

/// What is asked, and when, s of the session.
struct Asked {
  double at_s = 0;
  trial::UserCommand command = trial::UserCommand::pause;
};

Held heldWith(std::vector<Note> notes, NeedleWorld& world, std::vector<Asked> asked = {}) {
  SessionOptions options = quick(OperatorKind::expert, 41);
  options.trials = 2;
  options.meanwhile = [notes, asked](std::int64_t now_ns, trial::Channels& channels,
                                     runtime::StopSwitch&) mutable {
    if (!asked.empty() && 1e-9 * static_cast<double>(now_ns) >= asked.front().at_s) {
      channels.console_to_task.push(trial::UserRequest{asked.front().command, ""});
      asked.erase(asked.begin());
    }
    if (notes.empty() || 1e-9 * static_cast<double>(now_ns) < notes.front().said_s) return;
    channels.console_to_task.push(
        {trial::UserCommand::note, notes.front().text, notes.front().about_s});
    notes.erase(notes.begin());
  };
  const std::filesystem::path folder = freshPlace("noted");
  runNeedleSession(options, world, folder);
  const record::SessionReader evidence(folder / "session.palpa");
  return {evidence.trials(), evidence::whatWasNoted(evidence), armedIn(evidence)};
}

TEST(Noted, ARemarkBelongsToTheMomentThatItIsAbout) {
  NeedleWorld world(quick(OperatorKind::expert));
  world.station.camera_rate_Hz = 1;
  const Held before = heldWith({}, world);
  ASSERT_EQ(before.trials.size(), 2u);
  const double first_s = before.armed_s[0].first, over_s = before.armed_s[0].second,
               second_s = before.armed_s[1].first;
  ASSERT_GT(second_s, over_s + 1.5);
  const report::SessionPage page =
      heldWith({{first_s + 2, first_s + 1.5, "at once"},
                {over_s + 1, over_s + 1, "between"},
                {second_s + 1, first_s + 3, "typed until the next one"},
                {second_s + 2, 0, "without a moment"}},
               world)
          .noted;
  EXPECT_EQ(page.when, "") << "virtual time has no date";
  ASSERT_EQ(page.remarks.size(), 4u);
  EXPECT_EQ(page.remarks[0].trial, 1);
  EXPECT_NEAR(page.remarks[0].t_s, 1.5, 1e-6);
  EXPECT_EQ(page.remarks[1].trial, 0);
  EXPECT_EQ(page.remarks[1].text, "between");
  EXPECT_EQ(page.remarks[2].trial, 1);
  EXPECT_NEAR(page.remarks[2].t_s, 3, 1e-6);
  EXPECT_EQ(page.remarks[3].trial, 2);
  EXPECT_NEAR(page.remarks[3].t_s, 2, 0.1);
}

// The time of a trial is one: a note after a pause stands where the judge, curves and film have it.
TEST(Noted, APauseDoesNotCount) {
  NeedleWorld world(quick(OperatorKind::expert));
  world.station.camera_rate_Hz = 1;
  const double first_s = heldWith({}, world).armed_s.at(0).first;
  const Held held = heldWith(
      {{first_s + 9, first_s + 9, "after the pause"}, {first_s + 9.5, first_s + 4, "in the pause"}},
      world, {{first_s + 2, trial::UserCommand::pause}, {first_s + 8, trial::UserCommand::start}});
  ASSERT_EQ(held.noted.remarks.size(), 2u);
  // Asked a hundred times a second, heard sixty times: of each of two requests 27 ms at most.
  constexpr double kHeard_s = 2 * (1.0 / 100 + 1.0 / 60);
  EXPECT_NEAR(held.noted.remarks[0].t_s, 3, kHeard_s);
  EXPECT_NEAR(held.noted.remarks[1].t_s, 2, kHeard_s);
}

}  // namespace
}  // namespace palpa::session
