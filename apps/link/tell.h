#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/link/lrs_client.h"
#include "apps/link/outbox.h"
#include "apps/record/store/record_store.h"

namespace palpa::link {

/// What is to be told of one person or of all.
struct TellFilter {
  std::vector<record::Trainee> who;
  bool simulated = false;  ///< sessions that were simulated as well
  std::string home_page;   ///< of the accounts
};

struct Queued {
  int added = 0, known = 0;                         ///< statements put in now; put in before
  int simulated = 0, void_trials = 0, no_uuid = 0;  ///< trials left out
};

/// Puts a statement of every trial into the outbox; whoever has not agreed to training records is
/// not to be in `who`.
Queued queueTrials(record::RecordStore& store, const Route& route, const TellFilter& filter,
                   Outbox& outbox);

/// Takes back what was told of people who were deleted from these records since, and of trials that
/// are void now. Returns how many.
int takeBackDeleted(record::RecordStore& store, const Route& route, Outbox& outbox);

/// How often to try a store that does not answer rightly, and how long to wait in between; doubled
/// each time.
struct Pace {
  int tries = 4;
  std::int64_t pause_ns = 500'000'000;
};

struct Sent {
  int delivered = 0, present = 0;    ///< stored now; were there already
  std::vector<std::string> refused;  ///< in words; these go on waiting
  std::string trouble;               ///< why it was stopped early; empty: all were tried
  std::size_t left = 0;              ///< statements that wait
};

/// Sends what waits for this endpoint, in order: each by PUT under its own id, so that a lost
/// answer or a killed process cannot store it twice. Done is what the store confirms by 204, or has
/// already as it was told (409, then read and compared). Errors of the network or the store are
/// tried again and then waited out. Throws Error where user or password is refused or the address
/// is no learning record store.
Sent sendWaiting(Outbox& outbox, const Endpoint& endpoint, LrsClient& client,
                 const Pace& pace = {});

}  // namespace palpa::link
