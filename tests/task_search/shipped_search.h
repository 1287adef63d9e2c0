#pragma once

#include "apps/station/assets.h"
#include "apps/task_search/floors.h"

namespace palpa::task_search {

inline SearchSettings shippedSearch() {
  return readSearch(station::assetFile("tasks/search.json"));
}

inline Episode episodeWith(assess::SearchMode mode, double orientation = 0.4, int target = 1) {
  Episode e;
  e.mode = mode;
  e.stimulus = {orientation, target};
  e.seed = 7;
  return e;
}

}  // namespace palpa::task_search
