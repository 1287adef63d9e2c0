#include "apps/record/store/delivery.h"

#include <optional>

#include "apps/runtime/clock.h"

namespace palpa::record {

Delivered deliver(const std::string& url, const StoredSession& session,
                  const std::vector<StoredTrial>& trials, const Patience& patience) {
  Delivered delivered;
  std::optional<RecordStore> store;
  int tries = patience.tries;
  for (std::size_t i = 0; i < trials.size();) try {
      if (!store) store.emplace(url);
      (store->addTrial(session, trials[i]) ? delivered.added : delivered.present) += 1;
      ++i;
      tries = patience.tries;
    } catch (const StoreUnreachable&) {
      store.reset();
      if (--tries <= 0) throw;
      runtime::SteadyClock().sleepUntil(patience.pause_ns);
    }
  return delivered;
}

}  // namespace palpa::record
