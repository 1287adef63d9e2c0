#include <gtest/gtest.h>

#include <cmath>

#include "anatomy/base/error.h"
#include "apps/training/engine.h"
#include "apps/training/trial_words.h"
#include "practice.h"

namespace palpa::progress {
namespace {

using test::cleanTrial;
using test::set;

TEST(History, WhatDiffersIsNeverInOneSeries) {
  std::vector<PracticeTrial> trials;
  for (int i = 1; i <= 8; ++i) {
    PracticeTrial t = cleanTrial("A", i);
    t.simulated = i % 2 == 0;
    t.force_feedback = i % 4 < 2;
    if (i == 8) t.condition = "cues on";
    trials.push_back(t);
  }
  const std::vector<Series> all = seriesOf(trials);
  ASSERT_EQ(all.size(), 5u);
  for (const Series& series : all)
    for (const PracticeTrial& t : series.trials) {
      EXPECT_EQ(t.simulated, series.simulated);
      EXPECT_EQ(t.force_feedback, series.force_feedback);
      EXPECT_EQ(t.condition, series.condition);
    }
  EXPECT_EQ(all.back().name().find("subclavian access"), 0u);
}

TEST(History, WhatDoesNotCountIsNamed) {
  std::vector<PracticeTrial> trials(4, cleanTrial("A", 1));
  trials[1].role = training::Role::familiarisation;
  trials[2].outcome = training::Outcome::voided;
  trials[3].role = training::Role::not_scored;
  ASSERT_EQ(seriesOf(trials).size(), 1u);
  EXPECT_EQ(seriesOf(trials)[0].trials.size(), 1u);
  EXPECT_EQ(leftOut(trials), "1 familiarisation, 1 not scored, 1 void");
  EXPECT_EQ(leftOut({trials[0]}), "");
}

TEST(History, TrialsStandInOrderOfArrivalWhateverTheirDates) {
  PracticeTrial late = cleanTrial("A", 1, "2001-01-01T00:00:00Z"),
                early = cleanTrial("A", 2, "2027-01-01T00:00:00Z");
  late.arrival = 2;
  const Series series = seriesOf({late, early}).at(0);
  EXPECT_EQ(series.trials[0].number, 2);
  EXPECT_EQ(series.trials[1].number, 1);
}

TEST(History, WhatHarmsIsAFailure) {
  const PracticeTrial clean = cleanTrial("A", 1);
  EXPECT_FALSE(failed(clean));
  for (const auto& [metric, value] :
       {std::pair{"success", 0.0}, std::pair{"col_lung", 1.0}, std::pair{"col_artery", 1.0},
        std::pair{"needle_passes", 4.0}}) {
    PracticeTrial t = clean;
    set(t, metric, value);
    EXPECT_TRUE(failed(t)) << metric;
  }
  PracticeTrial three = clean;
  set(three, "needle_passes", 3);
  EXPECT_FALSE(failed(three));
}

TEST(History, EveryFigureShownIsInTheTable) {
  using training::Engine;
  const std::optional<Engine> unknown;
  for (const std::optional<Engine> engine :
       {std::optional(Engine::needle), std::optional(Engine::palpation),
        std::optional(Engine::search), std::optional(Engine::squeeze),
        std::optional(Engine::friction), std::optional(Engine::pulse), unknown})
    for (const std::string& name : shownFigures(engine)) {
      const metrics::MetricDefinition* definition = metrics::metricNamed(name);
      ASSERT_NE(definition, nullptr) << name;
      EXPECT_TRUE(!engine || metrics::belongsTo(*definition, training::nameOf(*engine))) << name;
    }
}

TEST(History, AnEngineIsKnownByItsFigures) {
  EXPECT_EQ(engineOfFigures({"success", "tissue_time_s"}), training::Engine::needle);
  EXPECT_EQ(engineOfFigures({"presses"}), training::Engine::palpation);
  EXPECT_EQ(engineOfFigures({"chosen"}), training::Engine::search);
  EXPECT_EQ(engineOfFigures({"grips"}), training::Engine::squeeze);
  EXPECT_EQ(engineOfFigures({"touches"}), training::Engine::friction);
  EXPECT_EQ(engineOfFigures({"pulse_found"}), training::Engine::pulse);
  EXPECT_EQ(engineOfFigures({}), std::nullopt);
  EXPECT_TRUE(std::isnan(cleanTrial("A", 1).metric("no such")));
}

/// A page that asks for a figure which trials do not keep must not take it for missing.
TEST(History, AFigureThatIsNotKeptIsRefused) {
  EXPECT_THROW(figureNumber("hausdorff_mm"), Error);
  PracticeTrial trial = cleanTrial("A", 1);
  trial.figures.set("hausdorff_mm", 3);
  EXPECT_THROW(trial.metric("hausdorff_mm"), Error);
  EXPECT_EQ(trial.metric("time_s"), 20);
  Figures other;
  EXPECT_TRUE(other.empty());
  other.set("hausdorff_mm", 3);
  EXPECT_FALSE(other.empty());
}

TEST(History, ATraineesTrialsAreViewsInTheirOrder) {
  std::vector<PracticeTrial> trials;
  for (const char* trainee : {"B", "A", "C"})
    for (int i = 3; i >= 1; --i) trials.push_back(cleanTrial(trainee, i));
  const Series series = seriesOf(trials).at(0);
  const std::vector<PracticeView> people = byTrainee(series);
  ASSERT_EQ(people.size(), 3u);
  for (std::size_t p = 0; p < people.size(); ++p) {
    EXPECT_EQ(people[p].trainee(), std::string(1, static_cast<char>('A' + p)));
    EXPECT_EQ(people[p].trials.data(), series.trials.data() + 3 * p);  // no copies
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(people[p].trials[i].number, static_cast<std::int64_t>(i + 1));
  }
}

}  // namespace
}  // namespace palpa::progress
