#pragma once

#include <functional>
#include <vector>

#include "apps/record/session_file.h"
#include "apps/task_search/search_task.h"

namespace palpa::cli {

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

}  // namespace palpa::cli
