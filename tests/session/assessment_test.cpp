#include <gtest/gtest.h>

#include <array>
#include <filesystem>

#include "anatomy/base/error.h"
#include "apps/evidence/recorded_session.h"
#include "apps/record/session_file.h"
#include "apps/session/palpation_session.h"
#include "apps/session/search_session.h"
#include "apps/session/session_options.h"
#include "apps/station/assets.h"
#include "apps/training/trial_words.h"
#include "tests/session/quick_sessions.h"

/// Assessment: no aid adds force in any tick, and a needle's trial ends at the fourth pass.
namespace palpa::session {
namespace {

SessionOptions settled(bool assess, std::uint64_t seed = 3) {
  SessionOptions options = quick(OperatorKind::expert, seed);
  options.assess = assess;
  settle(options);
  return options;
}

/// What aids did in a session, from every recorded tick.
struct Aids {
  long ticks = 0, with_force = 0, commanded = 0;
  bool assessed = false;
  std::vector<std::string> roles;
};

Aids aidsIn(const std::filesystem::path& folder) {
  const record::SessionReader reader(folder / "session.palpa");
  Aids aids;
  aids.assessed = reader.info().session_json.find("\"assessed\":true") != std::string::npos;
  for (const record::RecordedTrial& trial : reader.trials())
    aids.roles.push_back(trial.header.role);
  const auto zero = [](const Packed3& v) { return v == Packed3{}; };
  reader.ticks([&](const haptics::FlightRecord& r) {
    ++aids.ticks;
    aids.with_force += !zero(r.f_augmentation_D) || r.augmenting || r.began;
    aids.commanded += r.commands.augmented || !zero(r.commands.line_a_D);
  });
  return aids;
}

void expectNoAid(const Aids& aids) {
  EXPECT_GT(aids.ticks, 1000);
  EXPECT_EQ(aids.with_force, 0);
  EXPECT_EQ(aids.commanded, 0);
  EXPECT_TRUE(aids.assessed);
  EXPECT_EQ(aids.roles, std::vector<std::string>{"assessed"});
}

Aids ofNeedle(const SessionOptions& options, const std::string& name) {
  const std::filesystem::path folder = freshPlace(name);
  Quick<NeedleWorld> world(options);
  runNeedleSession(options, world, folder);
  return aidsIn(folder);
}

TEST(Assessment, NoAidAddsForceToANeedle) {
  expectNoAid(ofNeedle(settled(true), "assessed_needle"));
  SessionOptions practice = settled(false);  // the same trial with cues: the test would see them
  practice.augment = true;
  const Aids aids = ofNeedle(practice, "practice_needle");
  EXPECT_GT(aids.with_force, 0);
  EXPECT_GT(aids.commanded, 0);
  EXPECT_FALSE(aids.assessed);
  EXPECT_EQ(aids.roles, std::vector<std::string>{"scored"});
}

/// Guides, walls and a steadied hand: felt in the first trial of practice, the guides not in the
/// second, and nothing at all in an assessment.
TEST(Assessment, FixturesFadeAndAreExactlyZero) {
  SessionOptions assessed = settled(true);
  assessed.task = station::assetFile("tasks/paracentesis_guided.json").string();
  expectNoAid(ofNeedle(assessed, "assessed_guided"));
  SessionOptions practice = settled(false);
  practice.task = assessed.task;
  practice.augment = true;
  practice.trials = 2;
  const std::filesystem::path folder = freshPlace("practice_guided");
  Quick<NeedleWorld> world(practice);
  ASSERT_EQ(runNeedleSession(practice, world, folder).trials.size(), 2u);
  const record::SessionReader reader(folder / "session.palpa");
  std::array<long, 3> led{};  // ticks with a guide or a wall, of each trial
  bool walled = false;
  reader.ticks([&](const haptics::FlightRecord& r) {
    if (r.commands.trial < 1 || r.commands.trial > 2) return;
    led[r.commands.trial] += (r.augmenting & 3u) != 0;
    walled |= r.commands.kept_out[0].radius > 0;
    if (r.commands.trial == 2) {
      EXPECT_EQ(r.commands.support, 0);
    }
  });
  EXPECT_TRUE(walled);
  EXPECT_GT(led[1], 0);
  EXPECT_EQ(led[2], 0);
  EXPECT_EQ(reader.trials().at(0).header.role, "guided");
  EXPECT_EQ(reader.trials().at(1).header.role, "scored");
}

TEST(Assessment, NoAidAddsForceToAPalpation) {
  const SessionOptions options = settled(true);
  const std::filesystem::path folder = freshPlace("assessed_palpation");
  Quick<PalpationWorld> world(options);
  runPalpation(options, world, folder);
  expectNoAid(aidsIn(folder));
}

TEST(Assessment, NoAidAddsForceToASearch) {
  const SessionOptions options = settled(true);
  const std::filesystem::path folder = freshPlace("assessed_search");
  Quick<SearchWorld> world(options);
  runSearch(options, world, folder);
  expectNoAid(aidsIn(folder));
}

TEST(Assessment, EveryAidIsRefused) {
  const auto refused = [](auto&& set) {
    SessionOptions options;
    options.assess = options.fast = options.quiet = true;
    set(options);
    EXPECT_THROW(settle(options), UsageError);
  };
  refused([](SessionOptions& o) { o.guide = true; });
  refused([](SessionOptions& o) { o.guidance = true; });
  refused([](SessionOptions& o) { o.see_through = true; });
  refused([](SessionOptions& o) { o.augment = true; });
  refused([](SessionOptions& o) { o.skin_deflection = true; });
  refused([](SessionOptions& o) { o.mode = "augmented"; });
  refused([](SessionOptions& o) { o.mode = "all"; });
  refused([](SessionOptions& o) { o.blocks = true; });
  refused([](SessionOptions& o) { o.presentation = presentation::Presentation{}; });
  const SessionOptions left = settled(true);
  EXPECT_TRUE(presentation::unaided(shownIn(left)));
  EXPECT_FALSE(left.demonstration);
  EXPECT_EQ(left.role, training::Role::assessed);
}

double figureOf(const assess::TrialAssessment& a, const std::string& name) {
  for (const metrics::MetricValue& m : a.metrics)
    if (m.name == name) return m.value;
  return -1;
}

/// The same hand on the same patient: in practice it needs two passes or more, in assessment with a
/// limit of one the trial ends when the second begins.
TEST(Assessment, ThePassAfterTheLastEndsTheTrial) {
  const std::filesystem::path folder = freshPlace("passes");
  constexpr std::uint64_t kSeed = 610;  // finds the vein at last
  const auto run = [&](bool assess, int most) {
    SessionOptions options = settled(assess, kSeed);
    options.who = OperatorKind::novice;
    Quick<NeedleWorld> world(options);
    if (most > 0) world.task.most_passes.assessed = most;
    EXPECT_EQ(world.task.most_passes.practice, 0);
    return runNeedleSession(options, world, freshPlace("passes")).trials.at(0).assessment;
  };
  NeedleWorld shipped(settled(true));
  EXPECT_EQ(shipped.task.most_passes.assessed, 3);
  const assess::TrialAssessment practice = run(false, 0);
  ASSERT_GE(figureOf(practice, "needle_passes"), 2);
  EXPECT_EQ(practice.outcome, training::Outcome::success);
  const assess::TrialAssessment limited = run(true, 1);
  EXPECT_EQ(limited.outcome, training::Outcome::passes);
  EXPECT_FALSE(limited.values.success);
  EXPECT_EQ(figureOf(limited, "needle_passes"), 2);
  EXPECT_NE(limited.summary.find("a pass too many"), std::string::npos) << limited.summary;
  const evidence::RecordedSession recorded(folder / "session.palpa");
  int trials = 0;
  recorded.eachTrial(
      [&](const record::RecordedTrial& trial, const evidence::RecordedSession::Samples& samples) {
        ++trials;
        EXPECT_EQ(trial.end.outcome, "passes");
        EXPECT_EQ(recorded.rescore(trial, samples).total, limited.total);  // to the last bit
      });
  EXPECT_EQ(trials, 1);
}

}  // namespace
}  // namespace palpa::session
