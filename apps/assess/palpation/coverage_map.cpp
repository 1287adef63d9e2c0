#include "apps/assess/palpation/coverage_map.h"

#include <algorithm>
#include <cmath>

namespace palpa::assess {

CoverageMap::CoverageMap(const SearchArea& area, const PressureLevels& levels, double reach)
    : area_(area),
      levels_(levels),
      reach_(reach),
      columns_(std::max(1, static_cast<int>(std::lround(2 * area.half_x / kCell)))),
      rows_(std::max(1, static_cast<int>(std::lround(2 * area.half_y / kCell)))),
      cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

Vec3 CoverageMap::middle(int column, int row) const {
  return {-area_.half_x + (column + 0.5) * 2 * area_.half_x / columns_,
          -area_.half_y + (row + 0.5) * 2 * area_.half_y / rows_, 0};
}

void CoverageMap::add(const PalpationSample& sample) {
  std::int16_t level = 0;
  for (const double from : levels_) level = static_cast<std::int16_t>(level + (sample.f_n >= from));
  if (level == 0) return;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      if (!((middle(column, row) - sample.p_P).head<2>().norm() <= reach_))
        continue;  // a place that is none was not felt
      Cell& cell = cells_[index(column, row)];
      cell.visits = static_cast<std::int16_t>(cell.visits + (sample.t_s - cell.last_s > kAnew_s));
      cell.last_s = sample.t_s;
      cell.level = std::max(cell.level, level);
    }
  }
}

double CoverageMap::share(int level) const {
  const auto felt = std::count_if(cells_.begin(), cells_.end(),
                                  [&](const Cell& cell) { return cell.level >= level; });
  return static_cast<double>(felt) / static_cast<double>(cells_.size());
}

double CoverageMap::twice() const {
  const auto again =
      std::count_if(cells_.begin(), cells_.end(), [](const Cell& cell) { return cell.visits > 1; });
  return static_cast<double>(again) / static_cast<double>(cells_.size());
}

}  // namespace palpa::assess
