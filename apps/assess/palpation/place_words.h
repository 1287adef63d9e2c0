#pragma once

#include <array>
#include <string>
#include <vector>

#include "apps/assess/palpation/coverage_map.h"

/// Places in the words of the trainee, who stands at the near side: "far" is away from the trainee,
/// right is right.
namespace palpa::assess {

/// "far left", "near right", ...; "in the middle" within a quarter of the way to the edges.
std::string placeWords(const SearchArea& area, const Vec3& p_P);

/// The quarters that hold most of what has not been felt: the worst, and those at least half as
/// bad. Empty when all has been felt.
std::vector<std::string> unfeltQuarters(const CoverageMap& map);

}  // namespace palpa::assess
