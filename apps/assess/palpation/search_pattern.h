#pragma once

#include "apps/assess/palpation/palpation_sample.h"

namespace palpa::assess {

/// One press or stroke: from touch to lift.
struct Press {
  double from_s = 0, to_s = 0;
  Vec3 p_P = Vec3::Zero();  ///< mean place while it was pressed, weighted by force
  double peak = 0;          ///< N
  double slid = 0;          ///< m, way along the surface
  bool palpating = false;   ///< several presses about one place: a closer look; else it is search
};

/// Touch: from `touch` newtons on; lifted for less than a tenth of a second it is the same press. A
/// press is palpation where at least two of its neighbours in time, within 5 s before or after it,
/// lie within 5 mm of it [chosen: a third of a fingertip's breadth; who searches moves on by more],
/// and search where they do not: who searches goes on.
std::vector<Press> pressesIn(PalpationSamples samples, double touch);

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
