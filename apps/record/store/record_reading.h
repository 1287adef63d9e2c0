#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/record/store/record_store.h"

/// Records read row by row in their order: by trainee, arrival and number. Nothing is held but the
/// row that is visited, however many there are. Each within a transaction (`Access::read`: several
/// then see the same moment); who visits may ask the connection for other things meanwhile.
namespace palpa::record {

/// With their calibrations; also sessions without a trial.
void eachSession(SqlConnection& connection, const TrialFilter& filter,
                 const std::function<void(const StoredSession&)>& visit);

/// The session is the same object for all its trials, written anew with its first.
void eachTrial(SqlConnection& connection, const TrialFilter& filter,
               const std::function<void(const TrialWithSession&)>& visit);

struct TrialEvent {
  std::string trainee, session;
  std::int64_t number = 0;  ///< of the trial
  StoredEvent event;
};
void eachEvent(SqlConnection& connection, const TrialFilter& filter,
               const std::function<void(const TrialEvent&)>& visit);

/// By trainee; all but who has no session. Empty: of everybody.
std::vector<Tally> tallies(SqlConnection& connection, const std::string& trainee);

/// Names of all metrics that these trials have, in their order.
std::vector<std::string> metricNames(SqlConnection& connection, const TrialFilter& filter);

}  // namespace palpa::record
