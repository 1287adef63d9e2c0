#pragma once

#include <functional>
#include <vector>

#include "apps/record/session_file.h"
#include "apps/task_comparison/comparison_task.h"
#include "apps/task_palpation/palpation_task.h"
#include "apps/task_pulse/pulse_task.h"
#include "apps/task_search/search_task.h"
#include "apps/training/engine.h"

namespace palpa::evidence {

/// Calls `visit` with every trial of a palpation session and what was felt and marked in it, not
/// graded yet: one pass over the record, with one trial's touches in memory. Throws Error.
void eachPalpation(const record::SessionReader& reader,
                   const std::function<void(const record::RecordedTrial&,
                                            task_palpation::PalpationListener&)>& visit);

/// A palpation as its evidence tells it, judged again.
struct RecordedPalpation {
  record::RecordedTrial recorded;
  assess::PalpationAssessment assessment;
};

/// Needs nothing but the file: lumps and grades from its events, touches from its ticks, rules from
/// its task. Throws Error.
std::vector<RecordedPalpation> recordedPalpations(const record::SessionReader& reader);

/// "needle", "palpation": of the recorded task.
training::Engine engineOf(const record::SessionReader& reader);

struct RecordedSearch {
  record::RecordedTrial recorded;
  assess::SearchTrial again;  ///< from the ticks alone
};
/// Every episode of a search judged again, from the evidence alone. Throws Error for a record whose
/// parts contradict each other.
std::vector<RecordedSearch> recordedSearches(const record::SessionReader& reader);

/// The floors of a recorded search, made again one at a time as they are asked for, in the order of
/// the trials; empty where the session searched none.
std::function<const haptics::Floor*(std::uint32_t number)> recordedFloors(
    const record::SessionReader& reader);

struct RecordedComparison {
  record::RecordedTrial recorded;
  assess::ComparisonTrial again;  ///< from the ticks and what was said
};
/// Every trial of a comparison session judged again, from the evidence alone. Throws Error for a
/// record whose parts contradict each other.
std::vector<RecordedComparison> recordedComparisons(const record::SessionReader& reader);

struct RecordedPulse {
  record::RecordedTrial recorded;
  assess::PulseTrial again;  ///< from the ticks and what was said
};
/// Every trial of a pulse session judged again, from the evidence alone. Throws Error for a record
/// whose parts contradict each other.
std::vector<RecordedPulse> recordedPulses(const record::SessionReader& reader);

}  // namespace palpa::evidence
