#include "apps/assess/pulse/pulse_trial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

namespace palpa::assess {
namespace {

PulseTrial goodTrial() {
  PulseTrial t;
  t.trial = 1;
  t.role = training::Role::scored;
  t.outcome = training::Outcome::done;
  t.artery = "radial";
  t.rhythm = PulseRhythm::irregular;
  t.off_m = 0.002;
  t.found_s = 40;
  t.delivered = 36;
  t.counted = 37;
  t.said = PulseRhythm::irregular;
  t.seconds = 90;
  t.peak_N = 0.9;
  return t;
}

TEST(PulseTrial, RightIsFoundCountedAndTold) {
  const PulseRules rules;
  EXPECT_TRUE(goodTrial().right(rules));
  EXPECT_EQ(goodTrial().countError(rules), 2);  // a beat too many in 30 s
  PulseTrial t = goodTrial();
  t.counted = 34;
  EXPECT_FALSE(t.counts(rules));
  EXPECT_FALSE(t.right(rules));
  t = goodTrial();
  t.off_m = 0.02;
  EXPECT_FALSE(t.found(rules));
  t = goodTrial();
  t.said = PulseRhythm::regular;
  EXPECT_FALSE(t.told());
  t = goodTrial();
  t.outcome = training::Outcome::time;
  EXPECT_FALSE(t.right(rules));
  EXPECT_FALSE(PulseTrial{}.found(rules));
  EXPECT_FALSE(PulseTrial{}.countError(rules));
}

TEST(PulseTrial, IsSaidInWords) {
  const PulseRules rules;
  EXPECT_EQ(summaryOf(goodTrial(), rules),
            "Found (2 mm beside it); 74 counted, 72 a minute delivered; irregular: right.");
  PulseTrial t = goodTrial();
  t.off_m.reset();
  t.delivered.reset();
  t.said = PulseRhythm::premature;
  EXPECT_EQ(summaryOf(t, rules),
            "No place was marked; not counted to the end; said regular with premature beats, it "
            "was irregular.");
}

TEST(PulseTrial, TheChecklistSaysWhatWasNotDoneAndWhy) {
  const PulseRules rules;
  const auto done = [&](const PulseTrial& t) {
    const std::vector<PulseItem> items = pulseChecklist(t, rules);
    return std::count_if(items.begin(), items.end(), [](const PulseItem& i) { return i.done; });
  };
  EXPECT_EQ(done(goodTrial()), 7);
  PulseTrial t = goodTrial();
  t.peak_N = 3;
  t.shut_pct = 60;
  EXPECT_EQ(done(t), 5);
  for (const PulseItem& item : pulseChecklist(t, rules)) EXPECT_FALSE(item.why.empty());
  EXPECT_EQ(done(PulseTrial{}), 1);  // nothing was pressed too hard
}

TEST(PulseTrial, FiguresOfATrialMadeByHand) {
  PulseTrial t = goodTrial();
  t.counted = 33;
  t.shut_pct = 12;
  const std::vector<std::pair<const char*, double>> expected = {
      {"success", 0},      {"time_s", 90},           {"pulse_found", 1},
      {"pulse_off_mm", 2}, {"pulse_find_s", 40},     {"count_error_per_min", 6},
      {"rhythm_told", 1},  {"pressed_shut_pct", 12}, {"peak_force_N", 0.9}};
  const std::vector<metrics::MetricValue> all = pulseMetrics(t, PulseRules{});
  ASSERT_EQ(all.size(), expected.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].name, std::string(expected[i].first));
    EXPECT_NEAR(all[i].value, expected[i].second, 1e-9) << all[i].name;
    const metrics::MetricDefinition* definition = metrics::metricNamed(all[i].name);
    ASSERT_NE(definition, nullptr) << all[i].name;
    EXPECT_TRUE(metrics::belongsTo(*definition, "pulse")) << all[i].name;
  }
}

TEST(PulseTrial, EveryFigureOfTheTableIsGiven) {
  for (const metrics::MetricDefinition& d : metrics::metricTable()) {
    if (!metrics::belongsTo(d, "pulse") || d.name == std::string_view("success")) continue;
    const auto all = pulseMetrics(goodTrial(), PulseRules{});
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const auto& m) {
      return m.name == d.name;
    })) << d.name;
  }
}

TEST(PulseTrial, RhythmsHaveNames) {
  for (const PulseRhythm rhythm :
       {PulseRhythm::regular, PulseRhythm::premature, PulseRhythm::irregular})
    EXPECT_EQ(rhythmNamed(nameOf(rhythm)), rhythm);
  EXPECT_FALSE(rhythmNamed("waltz"));
}

}  // namespace
}  // namespace palpa::assess
