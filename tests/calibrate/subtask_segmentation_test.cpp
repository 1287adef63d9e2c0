#include "apps/calibrate/subtask_segmentation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "anatomy/base/random.h"
#include "apps/calibrate/subtask_result.h"
#include "tests/calibrate/a_calibration.h"
#include "tests/support/complaint.h"
#include "tests/support/counts.h"

/// Trials of which the regimes are known, cut into states and compared with labels that fit and
/// labels that do not.
namespace palpa::calibrate {
namespace {

using palpa::test::complaint, palpa::test::says;

struct Regime {
  double speed, force, contact, shaking;  // m/s, N, share, N
};
constexpr Regime kRegimes[] = {{0.12, 0.02, 0, 0.005}, {0.03, 0.4, 1, 0.1}, {0.004, 1.5, 1, 0.012}};
constexpr int kRegimeBits[] = {0, 1, 6};

/// Regimes held for 20 to 60 steps, one after the other; features scatter by a fifth.
std::vector<SubtaskSequence> plantedSequences(int trials, int steps, std::uint64_t seed) {
  RandomStream random = RandomStream::ofSeed(seed);
  std::vector<SubtaskSequence> all;
  for (int i = 0; i < trials; ++i) {
    SubtaskSequence q;
    q.trial = "trial " + std::to_string(i + 1);
    q.features.resize(steps, kSubtaskFeatures);
    int regime = i % 3, left = 40;
    for (int t = 0; t < steps; ++t, --left) {
      if (left == 0) {
        regime = (regime + (random.openUniform() < 0.7 ? 1 : 2)) % 3;
        left = 20 + static_cast<int>(40 * random.openUniform());
      }
      const Regime& r = kRegimes[regime];
      q.features.row(t) << std::log(r.speed) + 0.2 * random.openNormal(),
          std::log(r.force) + (r.contact > 0 ? 0.2 * random.openNormal() : 0), r.contact,
          std::log(r.shaking) + (r.contact > 0 ? 0.2 * random.openNormal() : 0);
      q.labels.push_back(kRegimeBits[regime]);
    }
    all.push_back(q);
  }
  return all;
}

SubtaskRecordings recordingsOf(const std::vector<SubtaskSequence>& sequences) {
  SubtaskRecordings recordings;
  recordings.task = "search";
  recordings.station = "search-bench";
  recordings.parts = {{"scan", ""}, {"shape", ""}, {"identify", ""}};
  recordings.sequences = sequences;
  recordings.simulated = true;
  recordings.files = {{"session.palpa", "12ab34cd56"}};
  return recordings;
}

/// Fitted once: it takes seconds.
const SubtaskSegmentation& plantedSegmentation() {
  static const SubtaskSegmentation found = segment(plantedSequences(5, 240, 3), {7, 0, {}});
  return found;
}

TEST(SubtaskSegmentation, FindsTheRegimesAndAgreesWithTheirLabels) {
  const SubtaskSegmentation& found = plantedSegmentation();
  EXPECT_EQ(found.states, 3);
  EXPECT_EQ(found.thinned_to, 1);
  EXPECT_LT(std::abs(found.neighbours), kIndependent);
  EXPECT_GT(found.repeated(), 0.95);
  EXPECT_GT(found.agreement.kappa, 0.98);
  EXPECT_GT(found.agreement.rand, 0.95);
  EXPECT_GT(found.agreement.boundaries.f(), 0.95);
  EXPECT_LT(found.by_chance.kappa, 0.4);
  EXPECT_LT(found.by_chance.boundary_f, 0.7);
  ASSERT_EQ(found.looks.size(), 3u);
  for (std::size_t row = 0; row < 3; ++row) {
    const StateLook& look = found.looks[row];
    const auto regime = static_cast<std::size_t>(
        std::find(std::begin(kRegimeBits), std::end(kRegimeBits), look.mostly) -
        std::begin(kRegimeBits));
    ASSERT_LT(regime, 3u);
    EXPECT_NEAR(look.speed / kRegimes[regime].speed, 1, 0.06);
    EXPECT_NEAR(look.force / kRegimes[regime].force, 1, 0.06);
    EXPECT_NEAR(look.shaking / kRegimes[regime].shaking, 1, 0.06);
    EXPECT_NEAR(look.contact, kRegimes[regime].contact, 0.01);
    EXPECT_GT(look.mostly_share, 0.97);
    EXPECT_GT(look.held_s, 0.2);
    EXPECT_LT(look.held_s, 0.8);
  }
}

TEST(SubtaskSegmentation, LabelsThatHaveNothingToDoWithItAgreeByChance) {
  std::vector<SubtaskSequence> sequences = plantedSequences(5, 240, 4);
  RandomStream random = RandomStream::ofSeed(5);
  for (SubtaskSequence& q : sequences)
    for (std::size_t i = q.labels.size(); i > 1; --i)
      std::swap(q.labels[i - 1],
                q.labels[static_cast<std::size_t>(random.openUniform() * static_cast<double>(i))]);
  const SubtaskSegmentation found = segment(sequences, {7, 3, {}});
  EXPECT_LT(found.agreement.kappa,
            0.12);  // the matching is in favour: above 0 by about 3 / sqrt(1200)
  EXPECT_LT(std::abs(found.agreement.rand), 0.02);
  EXPECT_LT(found.agreement.kappa, found.by_chance.kappa + 0.06);
  const Sentences words = howTheyAgree(recordingsOf(sequences), found);
  EXPECT_TRUE(says(words.front(), "little agreement"));
}

TEST(SubtaskSegmentation, SameSeedSameSegmentationAndAsManyStatesAsAsked) {
  const std::vector<SubtaskSequence> sequences =
      test::fullCounts() ? plantedSequences(4, 200, 6) : plantedSequences(3, 100, 6);
  int stages = 0;
  const SubtaskSegmentation one =
                                segment(sequences, {11, 2, [&](const std::string&) { ++stages; }}),
                            other = segment(sequences, {11, 2, {}});
  EXPECT_EQ(one.states, 2);
  EXPECT_EQ(one.paths, other.paths);
  EXPECT_EQ(one.model.mean, other.model.mean);
  EXPECT_EQ(one.by_chance.kappa, other.by_chance.kappa);
  EXPECT_GE(stages, 2);
  const Origin origin{
      "search-bench", "palpa calibrate subtasks",       "recorded sessions", "2026-03-01T12:30:00Z",
      true,           {{"session.palpa", "12ab34cd56"}}};
  const SubtaskRecordings recordings = recordingsOf(sequences);
  EXPECT_EQ(station::textOf(subtaskResult(recordings, one, origin).file),
            station::textOf(subtaskResult(recordings, other, origin).file));
}

TEST(SubtaskSegmentation, TheFileSaysTheModelAndTheWordsSayPlainUnits) {
  const SubtaskRecordings recordings = recordingsOf(plantedSequences(5, 240, 3));
  const SubtaskSegmentation& found = plantedSegmentation();
  const Result r = subtaskResult(recordings, found,
                                 {"search-bench", "palpa calibrate subtasks", "recorded sessions",
                                  "2026-03-01T12:30:00Z", true, recordings.files});
  EXPECT_EQ(r.file.kind, station::CalibrationKind::subtasks);
  EXPECT_EQ(r.file.verdict, "pass");
  EXPECT_TRUE(r.file.simulated);
  EXPECT_EQ(r.file.at("states", 1)[0], 3);
  EXPECT_EQ(r.file.at("kappa", 1)[0], found.agreement.kappa);
  EXPECT_EQ(r.file.at("standardised_by_log_speed", 2)[0], found.centre[0]);
  double moves = 0;
  for (const double p : r.file.at("move_from_state_2", 3)) moves += p;
  EXPECT_NEAR(moves, 1, 1e-9);
  double steps = 0;
  for (const char* label : {"no part", "scan", "shape + identify"})
    for (const double n : r.file.at(std::string("steps_by_state of ") + label, 3)) steps += n;
  EXPECT_EQ(steps, 1200);
  std::string all;
  for (const std::string& sentence : r.sentences) all += sentence + "\n";
  for (const char* words :
       {"Proposed: 3 states", "This is repeatable",
        " mm/s, under 0.02 N, in contact 0 % of its time, force shaking by under 0.005 N",
        "no part", "goes with \"shape + identify\"", "close agreement"})
    EXPECT_TRUE(says(all, words)) << words << "\n" << all;
}

TEST(SubtaskSegmentation, WhatCannotBeCutIsNamed) {
  const std::vector<SubtaskSequence> good = plantedSequences(4, 200, 6);
  EXPECT_TRUE(says(complaint([&] { segment({good[0]}); }),
                   "1 trial is too few: 2 are needed, because some must be held out to judge by. "
                   "Give a recording of more trials, or more recordings"));
  EXPECT_TRUE(says(complaint([&] { segment({}); }), "0 trials are too few"));
  EXPECT_TRUE(says(complaint([&] { segment(plantedSequences(2, 10, 1)); }),
                   "too short or too much alike for 2 states: 20 steps of 10 ms"));
  std::vector<SubtaskSequence> alike = good;
  for (SubtaskSequence& q : alike) q.features.setConstant(1);
  EXPECT_TRUE(says(complaint([&] { segment(alike); }), "0 of 4 features change"));
  alike = good;
  alike[1].labels.pop_back();
  EXPECT_TRUE(says(complaint([&] { segment(alike); }),
                   "trial 2: its features and labels do not belong together"));
}

}  // namespace
}  // namespace palpa::calibrate
