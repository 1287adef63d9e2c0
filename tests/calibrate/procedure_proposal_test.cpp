#include "apps/calibrate/procedure_proposal.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"

/// A library learned from planted recordings, and what it proposes for others.
namespace palpa::calibrate {
namespace {

constexpr int kStepsOfTrial = 600, kVisit = 60;  // of 10 ms

/// Named, with one profile that says nothing yet.
calibration::ProcedureLibrary writtenLibrary() {
  calibration::ProcedureLibrary library;
  library.source = library.made_by = "a test";
  library.any.assign(static_cast<std::size_t>(calibration::kInteractionFeatures), {0, 1});
  for (const char* name : {"rub", "rest", "never"}) {
    calibration::InteractiveProcedure p;
    p.name = p.means = p.source = name;
    p.cue = {"pulse", "a push", "a test"};
    calibration::ProcedureProfile profile;
    profile.from = "written";
    profile.features.assign(static_cast<std::size_t>(calibration::kInteractionFeatures), {50, 1});
    p.profiles = {profile};
    library.procedures.push_back(p);
  }
  library.labels = {{"own", {"fast"}, -1, "rub", "a test"},
                    {"own", {}, 2, "", "says nothing"},
                    {"own", {}, -1, "rest", "a test"}};
  return library;
}

/// Rubbing and resting in turn; the label is right. Number 2 says nothing.
SubtaskRecordings plantedRecording(std::uint64_t phase, int part) {
  SubtaskRecordings r;
  r.task = "own";
  r.parts = {{"slow", ""}, {"fast", ""}};
  r.simulated = true;
  SubtaskSequence q;
  q.trial = "trial 1";
  q.motion = Eigen::MatrixXd::Zero(kStepsOfTrial, int(calibration::kInteractionFeatures));
  for (int t = 0; t < kStepsOfTrial; ++t) {
    const bool rubs = (static_cast<std::uint64_t>(t) + phase) / kVisit % 2;
    q.motion(t, calibration::kReversals) = (rubs ? 5 : 0) + 0.3 * (t % 3);
    q.labels.push_back(rubs ? 3 : 0);
    q.parts.push_back(part);
  }
  r.sequences = {q};
  return r;
}

TEST(ProcedureProposal, LabelsMeanTheFirstRuleThatFits) {
  const calibration::ProcedureLibrary library = writtenLibrary();
  const SubtaskRecordings r = plantedRecording(0, 0);
  EXPECT_EQ(procedureOf(library, r, 3, 0), 0);  // slow as well as fast
  EXPECT_EQ(procedureOf(library, r, 0, 0), 1);
  EXPECT_EQ(procedureOf(library, r, 3, 2), 0);
  EXPECT_EQ(procedureOf(library, r, 0, 2), kNoProcedure);
  EXPECT_EQ(procedureOf(library, r, 1, 0), kNoProcedure);  // slow alone: no rule
  SubtaskRecordings other = r;
  other.task = "another";
  EXPECT_EQ(procedureOf(library, other, 3, 0), kNoProcedure);
}

TEST(ProcedureProposal, WhatWasLearnedIsFoundInOtherRecordings) {
  const calibration::ProcedureLibrary library =
      learnedFrom(writtenLibrary(), {plantedRecording(0, 0), plantedRecording(17, 0)}, 1);
  EXPECT_EQ(library.procedures[0].profiles[0].from, "own");
  EXPECT_EQ(library.procedures[2].profiles[0].from, "written");
  const ProcedureProposal proposal = propose(library, {plantedRecording(31, 0)});
  EXPECT_GT(proposal.agreement.kappa, 0.9);
  EXPECT_EQ(proposal.agreement.judged, kStepsOfTrial);
  EXPECT_GT(proposal.agreement.each[0].recall(), 0.9);
  EXPECT_EQ(proposal.agreement.each[2].labelled, 0);
  EXPECT_TRUE(proposal.simulated);
  ASSERT_FALSE(proposal.sequences[0].parts.empty());
  EXPECT_EQ(proposal.sequences[0].parts.front().from_s, 0);
  EXPECT_NEAR(proposal.sequences[0].parts.back().to_s, 0.01 * kStepsOfTrial, 1e-9);
  const nlohmann::ordered_json file = toJson(proposal);
  EXPECT_EQ(file["trials"][0]["parts"][0]["cue"], "pulse");
  EXPECT_EQ(file["tasks"][0]["task"], "own");
}

TEST(ProcedureProposal, WhatNoLabelSaysIsNotJudgedAndNothingIsNothing) {
  const calibration::ProcedureLibrary library =
      learnedFrom(writtenLibrary(), {plantedRecording(0, 0)}, 1);
  const ProcedureProposal proposal = propose(library, {plantedRecording(31, 2)});
  EXPECT_LT(proposal.agreement.judged, kStepsOfTrial);  // rubbing alone
  EXPECT_THROW(propose(library, {}), Error);
  SubtaskRecordings other = plantedRecording(0, 0);
  other.task = "another";
  EXPECT_EQ(propose(library, {other}).agreement.judged, 0);
  EXPECT_THROW(learnedFrom(writtenLibrary(), {other}, 1), Error);
}

}  // namespace
}  // namespace palpa::calibrate
