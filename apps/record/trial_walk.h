#pragma once

#include <functional>
#include <vector>

#include "apps/record/session_file.h"

namespace palpa::record {

/// What a walk calls, trial by trial in the order of their numbers. All three must be given.
struct TrialVisitor {
  std::function<void(const RecordedTrial&)> begin;
  std::function<void(const haptics::FlightRecord&)> tick;
  std::function<void(const RecordedTrial&)> finish;
};

/// One pass over the record: of each trial `begin`, `tick` with its ticks, `finish`. A trial lasts
/// until its end or the first tick that bears a higher number; ticks that bear a lower one, as
/// before the first trial, are passed on with the trial that comes next. A trial without ticks is
/// begun and finished as well. `trials`: as the reader gives them. Throws what reader and visitor
/// throw.
void walkTrials(const SessionReader& reader, const std::vector<RecordedTrial>& trials,
                const TrialVisitor& visitor);

}  // namespace palpa::record
