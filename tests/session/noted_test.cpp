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
};

Held heldWith(std::vector<Note> notes, NeedleWorld& world) {
  SessionOptions options = quick(OperatorKind::expert, 41);
  options.trials = 2;
  options.meanwhile = [notes](std::int64_t now_ns, trial::Channels& channels,
                              runtime::StopSwitch&) mutable {
    if (notes.empty() || 1e-9 * static_cast<double>(now_ns) < notes.front().said_s) return;
    channels.console_to_task.push(
        {trial::UserCommand::note, notes.front().text, notes.front().about_s});
    notes.erase(notes.begin());
  };
  const std::filesystem::path folder = freshPlace("noted");
  runNeedleSession(options, world, folder);
  const record::SessionReader evidence(folder / "session.palpa");
  return {evidence.trials(), evidence::whatWasNoted(evidence)};
}

double seconds(std::int64_t ns) { return 1e-9 * static_cast<double>(ns); }

TEST(Noted, ARemarkBelongsToTheMomentThatItIsAbout) {
  NeedleWorld world(quick(OperatorKind::expert));
  world.station.camera_rate_Hz = 1;
  const std::vector<record::RecordedTrial> trials = heldWith({}, world).trials;
  ASSERT_EQ(trials.size(), 2u);
  const double first_s = seconds(trials[0].header.t_ns), over_s = seconds(trials[0].end.t_ns),
               second_s = seconds(trials[1].header.t_ns);
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

}  // namespace
}  // namespace palpa::session
