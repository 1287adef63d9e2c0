#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/assess/metrics/metric_table.h"
#include "apps/training/engine.h"
#include "apps/training/trial_words.h"

namespace palpa::progress {

/// The figures that pages of practice use, numbered; those of a trial stand in this order. Throws
/// Error for a metric that this program knows and these pages do not keep; `kNoFigure` for a name
/// that it does not know.
inline constexpr std::size_t kFigures = 44, kNoFigure = kFigures;
std::size_t figureNumber(std::string_view metric);
/// The same; `kNoFigure` for every metric that is not kept.
std::size_t keptNumber(std::string_view metric);

/// Those of one trial: numbers side by side, without their names, since a cohort has a hundred
/// thousand trials.
class Figures {
 public:
  Figures();
  Figures(std::initializer_list<metrics::MetricValue> values);
  void set(std::string_view metric, double value) { set(keptNumber(metric), value); }
  void set(std::size_t number, double value) {
    any_ = true;
    if (number < kFigures) values_[number] = value;
  }
  double operator[](std::size_t number) const {  ///< not a number where there is none
    return values_[number];
  }
  bool empty() const { return !any_; }  ///< none was set, kept or not

 private:
  bool any_ = false;
  std::array<double, kFigures + 1> values_;  ///< the last: always not a number
};

/// A trial as the records keep it, with what its session says of it. Times are UTC, ISO 8601.
struct PracticeTrial {
  std::string trainee;
  std::string task;                        ///< "paracentesis", ...
  std::optional<training::Engine> engine;  ///< none: not known
  std::string started_utc;                 ///< of its session, as the station's clock had it
  std::int64_t arrival = 0;  ///< of its session, in the order in which this trainee's came
  std::int64_t number = 0;   ///< in its session
  training::Role role = training::Role::none;
  training::Outcome outcome = training::Outcome::none;
  bool simulated = false, force_feedback = true;
  std::string condition;  ///< what else differed: "cues on", "guided"; empty: nothing
  Figures figures;
  double metric(std::string_view name) const { return figures[figureNumber(name)]; }
  bool succeeded() const;
};

/// Scored and finished: everything else is counted apart.
bool counts(const PracticeTrial& trial);

/// Of a trial that has just been judged what is asked for that.
struct JudgedTrial {
  training::Role role = training::Role::none;
  training::Outcome outcome = training::Outcome::none;
  std::vector<metrics::MetricValue> figures;
};
/// Of a session's trials those that count, as practice.
std::vector<PracticeTrial> practiceOf(training::Engine engine,
                                      const std::vector<JudgedTrial>& session);

/// A trial that is a failure to whoever judges practice: without success, or of a needle one that
/// touched lung or artery or took more than three passes.
bool failed(const PracticeTrial& trial);

struct Series;

/// Trials in their order, of a series or of one trainee in it; they stay where they are.
struct PracticeView {
  std::optional<training::Engine> engine;
  std::span<const PracticeTrial> trials;
  PracticeView(std::optional<training::Engine> of_engine, std::span<const PracticeTrial> of_trials)
      : engine(of_engine), trials(of_trials) {}
  PracticeView(const Series& series);
  const std::string& trainee() const { return trials.front().trainee; }
  std::vector<double> values(
      std::string_view metric) const;  ///< one a trial; not a number where it does not apply
  std::size_t successes() const;
};

/// Without those that are not a number.
std::vector<double> finite(std::vector<double> values);

/// Of each trial whether it failed.
std::vector<bool> failuresIn(const PracticeView& practice);

/// Trials that may stand in one figure: of one task and condition, all simulated or none, all with
/// force feedback or all without; in the order in which they came.
struct Series {
  std::string task;
  std::optional<training::Engine> engine;
  std::string condition;
  bool simulated = false, force_feedback = true;
  std::vector<PracticeTrial> trials;
  std::vector<double> values(std::string_view metric) const;  ///< as PracticeView
  std::string name() const;  ///< "subclavian access, force feedback off, simulated"
};

/// Those that count, longest series first; trials of one series by trainee, arrival and number.
std::vector<Series> seriesOf(std::vector<PracticeTrial> trials);

/// By trainee, in the order of their names: views of the series, which must outlive them.
std::vector<PracticeView> byTrainee(const Series& series);

/// "3 familiarisation, 1 void": what does not count, by kind; empty: nothing.
std::string leftOut(const std::vector<PracticeTrial>& trials);

/// The engine that makes figures of such names; none: no such engine is known.
std::optional<training::Engine> engineOfFigures(const std::vector<std::string>& metrics);

/// Figures that a page shows of an engine, the most telling first.
const std::vector<std::string>& shownFigures(std::optional<training::Engine> engine);

}  // namespace palpa::progress
