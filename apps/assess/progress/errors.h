#pragma once

#include <string>
#include <vector>

#include "apps/assess/needle/paracentesis_score.h"
#include "apps/assess/progress/history.h"
#include "apps/training/engine.h"

namespace palpa::progress {

/// Something that goes wrong in a trial, told by its figures.
struct ErrorKind {
  const char* metric;
  double above;          ///< it happened when the metric is above this ...
  bool below;            ///< ... or, where this is true, below it
  const char* words;     ///< "the pleura was touched"
  const char* practise;  ///< what to practise against it
};

/// Those of an engine, the gravest first.
const std::vector<ErrorKind>& errorKinds(std::optional<training::Engine> engine);

/// In how many trials of several an error happened.
struct Happened {
  int with = 0, of = 0;  ///< trials with it, trials in which it can be told
};
Happened happenedIn(const ErrorKind& kind, std::span<const PracticeTrial> trials);

/// How often an error happened in a series.
struct ErrorCount {
  const ErrorKind* kind = nullptr;
  Happened all, lately;  ///< lately: among the last five
  bool recurs() const { return lately.with >= 2; }
};
/// Every kind that happened at least once, in the order of the kinds.
std::vector<ErrorCount> errorsIn(const PracticeView& practice);

/// What to practise next, at most two things, in words that follow "Practise next:": against what
/// went wrong at least twice in the last five trials, else in the last one; where nothing did, the
/// same on others or again. Empty without a trial.
std::vector<std::string> practiseNext(const PracticeView& practice);

/// The same after the trials of one session, of which those count that are scored and finished.
std::vector<std::string> practiseNext(training::Engine engine,
                                      const std::vector<JudgedTrial>& session);

/// What a part of the score costs, a trial.
struct Cost {
  const char* metric;
  double points = 0;
};
/// Means over the last five trials, the dearest first, nothing that costs nothing. Empty where
/// these weights do not add up to the recorded totals: the task weighs otherwise.
std::vector<Cost> costsLately(const Series& series);

/// The nearest miss: the smallest distance that was kept from lung or artery without touching it.
struct NearestMiss {
  double distance_mm = 0, at_s = 0;
  std::size_t trial = 0;  ///< of the series, from 1
};
/// `organ`: "pleura", "artery". None where there is no such distance.
std::vector<NearestMiss> nearestMisses(const Series& series, const std::string& organ,
                                       std::size_t most = 3);

}  // namespace palpa::progress
