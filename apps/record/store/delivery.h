#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/record/store/record_store.h"

namespace palpa::record {

/// How often to try a store that cannot be reached, and how long to wait in between.
struct Patience {
  int tries = 3;
  std::int64_t pause_ns = 500'000'000;
};

struct Delivered {
  int added = 0;    ///< trials that were not there
  int present = 0;  ///< trials that were there already
};

/// Brings all trials of a session into the store at `url`: one transaction each, in order,
/// connecting anew where the connection was lost. What is there already stays, so that it may be
/// called again after any failure, a killed process among them. Throws what RecordStore throws;
/// StoreUnreachable when patience is at its end.
Delivered deliver(const std::string& url, const StoredSession& session,
                  const std::vector<StoredTrial>& trials, const Patience& patience = {});

}  // namespace palpa::record
