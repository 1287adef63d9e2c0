#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "anatomy/query/surface_query.h"
#include "apps/assess/force_balance.h"
#include "apps/assess/needle/assess_trial.h"
#include "apps/assess/needle/needle_views.h"
#include "apps/assess/needle/trial_assessment.h"
#include "apps/assess/needle/trial_sampler.h"
#include "apps/record/session_file.h"
#include "apps/task_needle/task_file.h"
#include "calibration/expert_path.h"
#include "haptics/loop/tick_forces.h"

namespace palpa::evidence {

using NeedleSamples = std::vector<assess::TrialSample>;

/// Calls `visit` with every trial of a needle session and all its judged ticks, in A: one pass over
/// the record, with one trial's ticks in memory. Throws Error.
void eachNeedleTrial(
    const record::SessionReader& reader, const Pose& X_DA,
    const std::function<void(const record::RecordedTrial&, const NeedleSamples&)>& visit);

/// A session as its evidence tells it; needs nothing but the file.
class RecordedSession {
 public:
  explicit RecordedSession(const std::filesystem::path& file);  ///< throws Error

  const record::SessionReader& reader() const { return *reader_; }
  const anatomy::Patient& patient() const { return patient_; }
  const task_needle::TaskWords& words() const { return task_.words; }
  const Pose& X_DA() const { return X_DA_; }
  bool simulated() const { return simulated_; }
  const std::string& operatorName() const { return operator_; }
  const anatomy::SurfaceQuery& query() const { return *query_; }
  const std::string& trainee() const { return trainee_; }  ///< pseudonym of who performed
  const std::vector<record::RecordedTrial>& trials() const { return trials_; }
  using Samples = NeedleSamples;
  void eachTrial(
      const std::function<void(const record::RecordedTrial&, const Samples&)>& visit) const {
    eachNeedleTrial(*reader_, X_DA_, visit);
  }
  bool hasGoal() const { return task_.goal.has_value(); }  ///< else the vein, by an expert path
  /// The trial scored again, from the evidence alone: of a task with a goal of its own success,
  /// time and course. Throws Error when no expert path was recorded.
  assess::TrialAssessment rescore(const record::RecordedTrial& trial, const Samples& samples) const;
  /// The same, of a session that was not to be scored as well.
  assess::TrialAssessment judged(const record::RecordedTrial& trial, const Samples& samples) const;
  const task_needle::TaskSettings& task() const { return task_; }
  /// Where a needle's track can be seen; none where the task teaches no way to a vein.
  std::optional<assess::NeedleViews> views() const {
    return taught_path_ ? std::optional(assess::needleViewsOf(patient_, *taught_path_))
                        : std::nullopt;
  }

 private:
  std::unique_ptr<record::SessionReader> reader_;
  anatomy::Patient patient_;
  std::unique_ptr<anatomy::SurfaceQuery> query_;
  std::optional<calibration::TaughtPath> taught_path_;
  task_needle::TaskSettings task_;
  Pose X_DA_ = Pose::Identity();
  bool simulated_ = false;
  std::string operator_, trainee_;
  std::vector<record::RecordedTrial> trials_;
};

/// A needle's trial as the session judged it, with what the parts of the task were given.
struct RecordedNeedle {
  record::RecordedTrial recorded;
  assess::TrialAssessment again;
};
/// Every trial of a session, from the evidence alone, in one pass. Throws Error.
std::vector<RecordedNeedle> recordedNeedles(const RecordedSession& session);

/// How a record compares with what is computed again from it. Another processor's or an older
/// version's arithmetic moves last bits; who changes a record moves more.
enum class Likeness {
  same_bits,
  rounding,  ///< every number within kRounding, everything else equal
  changed
};

/// Of numbers: of their size, or absolute below 1.
inline constexpr double kRounding = 1e-9;

/// Not a number is like itself.
Likeness likeness(double recorded, double again);
/// Of two JSON texts: numbers as above, everything else equal or not. Throws Error for a text that
/// is no JSON.
Likeness likenessOfJson(const std::string& recorded, const std::string& again);

inline Likeness worse(Likeness a, Likeness b) { return a < b ? b : a; }

/// Outcome of running every recorded tick again.
struct ReplayCheck {
  std::int64_t recorded = 0;   ///< ticks in the record; of two tools, both
  std::int64_t ticks = 0;      ///< run again: from the first keyframe on, but for gaps
  std::int64_t different = 0;  ///< not the same bits; from the next keyframe on, its state counts
  std::int64_t changed = 0;    ///< of these: by more than rounding
  std::int64_t first_difference = -1, first_change = -1;  ///< number of the tick
  double largest = 0;     ///< of the differences by rounding; N, N m, m
  std::int64_t gaps = 0;  ///< ticks missing in the record; the state is then taken from a keyframe
  Likeness likeness() const;  ///< of the forces
};
/// `floors`: of a search, by number; null where there is none. `visit`, where it is given, is
/// called with every recorded tick in order, and what its force is made of: null for a tick that
/// could not be run again, or came out changed.
ReplayCheck replayTicks(
    const record::SessionReader& reader,
    const std::function<const haptics::Floor*(std::uint32_t number)>& floors = {},
    const record::VisitTick& visit = {});

/// Whether the forces in a record add up, over all its trials; none where the device measured
/// neither hand nor itself. Throws Error for a description that is damaged.
std::optional<assess::ForceBalance> recordedBalance(const record::SessionReader& reader);

/// Every tenth tick for the plots; what happened in between is merged into the one kept.
std::vector<assess::TrialSample> thinned(const std::vector<assess::TrialSample>& samples);

}  // namespace palpa::evidence
