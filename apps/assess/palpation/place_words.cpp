#include "apps/assess/palpation/place_words.h"

#include <algorithm>
#include <cmath>

namespace palpa::assess {
namespace {

constexpr double kMiddle = 0.25;  // of the way from the middle to an edge
constexpr std::array<const char*, 4> kQuarters{"far left", "far right", "near left", "near right"};

std::size_t quarterOf(const Vec3& p_P) { return (p_P.y() < 0 ? 2u : 0u) + (p_P.x() < 0 ? 0u : 1u); }

}  // namespace

std::string placeWords(const SearchArea& area, const Vec3& p_P) {
  if (std::abs(p_P.x()) <= kMiddle * area.half_x && std::abs(p_P.y()) <= kMiddle * area.half_y)
    return "in the middle";
  return kQuarters[quarterOf(p_P)];
}

std::vector<std::string> unfeltQuarters(const CoverageMap& map) {
  std::array<int, 4> unfelt{};
  for (int row = 0; row < map.rows(); ++row)
    for (int column = 0; column < map.columns(); ++column)
      unfelt[quarterOf(map.middle(column, row))] += map.level(column, row) == 0;
  const int worst = *std::max_element(unfelt.begin(), unfelt.end());
  std::vector<std::string> quarters;
  for (std::size_t i = 0; i < unfelt.size(); ++i)
    if (worst > 0 && 2 * unfelt[i] >= worst) quarters.push_back(kQuarters[i]);
  return quarters;
}

}  // namespace palpa::assess
