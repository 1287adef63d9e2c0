#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/evidence/evidence_records.h"
#include "apps/evidence/recorded_session.h"
#include "apps/session/needle_session.h"
#include "tests/session/quick_sessions.h"
#include "tests/support/counts.h"
#include "tests/support/setting.h"

/// What a trial was worth is what its record says, for ever.
namespace palpa::session {
namespace {

/// Exactly. Not a number is equal to itself: the figure does not apply.
bool sameFigure(double stored, double live) {
  return (std::isnan(stored) && std::isnan(live)) || stored == live;
}

void expectSameScore(const assess::TrialAssessment& again, const std::string& scores_json) {
  const nlohmann::json stored = nlohmann::json::parse(scores_json);
  const assess::ParacentesisValues& v = again.values;
  for (const auto& [code, value] : {std::pair{"COL_LUNG", v.col_lung},
                                    {"COL_RIB", v.col_rib},
                                    {"COL_ART", v.col_art},
                                    {"COL_VEIN", v.col_vein},
                                    {"PHASE_1", v.phase_1},
                                    {"PHASE_2", v.phase_2},
                                    {"ECON_MEAN", v.econ_mean},
                                    {"ECON_VAR", v.econ_var},
                                    {"TIME", v.time_ms},
                                    {"SUCCESS", v.success ? 1.0 : 0.0},
                                    {"TOTAL", again.total}})
    EXPECT_EQ(stored.at(code).get<double>(), value) << code;
}

void expectSameMetrics(const std::vector<metrics::MetricValue>& live,
                       const record::StoredTrial& stored) {
  ASSERT_EQ(stored.metrics.size(), live.size());
  for (const metrics::MetricValue& m : live)
    EXPECT_TRUE(sameFigure(stored.metric(m.name), m.value))
        << m.name << ": " << stored.metric(m.name) << ", live " << m.value;
}

/// Records a session and judges it again from its file alone, with no place for other ones; answers
/// how many trials.
int recordAndRescore(const SessionOptions& options, NeedleWorld& world) {
  const test::Setting nowhere("TMPDIR", "/nowhere");
  const std::filesystem::path folder = freshPlace("rescore");
  const SessionResult session = runNeedleSession(options, world, folder);
  const evidence::RecordedSession recorded(folder / "session.palpa");
  int trials = 0;
  recorded.eachTrial(
      [&](const record::RecordedTrial& trial, const evidence::RecordedSession::Samples& samples) {
        expectSameScore(recorded.rescore(trial, samples), trial.end.scores_json);
        ++trials;
      });
  const evidence::EvidenceRecords stored = evidence::recordsOf(folder / "session.palpa");
  EXPECT_EQ(stored.trials.size(), session.trials.size());
  for (std::size_t i = 0; i < session.trials.size(); ++i)
    expectSameMetrics(session.trials[i].assessment.metrics, stored.trials.at(i));
  return trials;
}

TEST(Rescore, RecordedTrialsHaveTheirStoredScoresExactly) {
  const int each = palpa::test::counted(1, 13);  // 104 of all eight kinds
  int trials = 0;
  for (const anatomy::Side side : {anatomy::Side::right, anatomy::Side::left}) {
    SessionOptions options = quick(OperatorKind::expert);
    options.side = side;
    options.trials = each;
    Quick<NeedleWorld> world(options);
    int kind = 0;
    for (const OperatorKind who : {OperatorKind::expert, OperatorKind::novice})
      for (const bool felt : {true, false}) {
        if (!palpa::test::fullCounts() && kind++ != (side == anatomy::Side::left ? 3 : 0))
          continue;  // the expert on the right, the numb novice on the left
        options.who = who;
        options.force_feedback = felt;
        options.seed = 300 + static_cast<std::uint64_t>(100 * trials);
        trials += recordAndRescore(options, world);
      }
  }
  EXPECT_GE(trials, palpa::test::counted(2, 100));
}

}  // namespace
}  // namespace palpa::session
