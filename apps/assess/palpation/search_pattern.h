#pragma once

#include "apps/assess/palpation/presses.h"

namespace palpa::assess {

/// How somebody goes over an area.
enum class SearchPattern { none, strips, rows, spiral };
const char* nameOf(SearchPattern pattern);

/// From the places of the searching presses in their order, and how well it was kept, 0 to 1 (1:
/// never left). Strips go up and down (along y) while they move on to one side, as is taught
/// (vertical strips miss least: Barton, Harris and Fletcher, JAMA 282, 1999); rows the same along
/// x; a spiral turns one way, two times or more, while its radius grows or shrinks.
struct SearchedPattern {
  SearchPattern pattern = SearchPattern::none;
  double kept = 0;
};
SearchedPattern patternOf(const std::vector<Press>& presses, const SearchArea& area);

}  // namespace palpa::assess
