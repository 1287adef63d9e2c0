#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/assess/metrics/metric_table.h"
#include "apps/training/engine.h"
#include "apps/training/trial_words.h"

namespace palpa::progress {

/// A trial as the records keep it, with what its session says of it. Times are UTC, ISO 8601.
struct PracticeTrial {
  std::string trainee, group;
  std::string task;                        ///< "paracentesis", ...
  std::optional<training::Engine> engine;  ///< none: not known
  std::string started_utc;                 ///< of its session, as the station's clock had it
  std::int64_t arrival = 0;  ///< of its session, in the order in which this trainee's came
  std::int64_t number = 0;   ///< in its session
  training::Role role = training::Role::none;
  training::Outcome outcome = training::Outcome::none;
  bool simulated = false, force_feedback = true;
  std::string condition;  ///< what else differed: "cues on", "guided"; empty: nothing
  std::vector<metrics::MetricValue> metrics;
  double metric(const std::string& name) const;  ///< not a number where it has none of that name
  bool succeeded() const { return metric("success") == 1; }
};

/// Scored and finished: everything else is counted apart.
bool counts(const PracticeTrial& trial);

/// A trial that is a failure to whoever judges practice: without success, or of a needle one that
/// touched lung or artery or took more than three passes.
bool failed(const PracticeTrial& trial);

/// Trials that may stand in one figure: of one task and condition, all simulated or none, all with
/// force feedback or all without; in the order in which they came.
struct Series {
  std::string task;
  std::optional<training::Engine> engine;
  std::string condition;
  bool simulated = false, force_feedback = true;
  std::vector<PracticeTrial> trials;
  std::vector<double> values(
      const std::string& metric) const;  ///< one a trial; not a number where it does not apply
  std::string name() const;              ///< "paracentesis, force feedback off, simulated"
};

/// Those that count, longest series first; trials of one series by trainee, arrival and number.
std::vector<Series> seriesOf(const std::vector<PracticeTrial>& trials);

/// By trainee, in the order of their names.
std::vector<Series> byTrainee(const Series& series);

/// "3 familiarisation, 1 void": what does not count, by kind; empty: nothing.
std::string leftOut(const std::vector<PracticeTrial>& trials);

/// The engine that makes such figures; none: no such engine is known.
std::optional<training::Engine> engineOfFigures(const std::vector<metrics::MetricValue>& metrics);

/// Figures that a page shows of an engine, the most telling first.
const std::vector<std::string>& shownFigures(std::optional<training::Engine> engine);

}  // namespace palpa::progress
