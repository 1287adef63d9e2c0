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
      cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      Cell& cell = cells_[index(column, row)];
      cell.asked = insideBy(area_, middle(column, row)) >= 0;
      cell.z = onTop(area_, middle(column, row)).z();
    }
  }
}

Vec3 CoverageMap::middle(int column, int row) const {
  return {-area_.half_x + (column + 0.5) * 2 * area_.half_x / columns_,
          -area_.half_y + (row + 0.5) * 2 * area_.half_y / rows_, 0};
}

void CoverageMap::add(const PalpationSample& sample) {
  std::int16_t level = 0;
  for (const double from : levels_) level = static_cast<std::int16_t>(level + (sample.f_n >= from));
  if (level == 0) return;
  const double z = onTop(area_, sample.p_P).z();
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      Cell& cell = cells_[index(column, row)];
      const Vec3 to = middle(column, row) - sample.p_P;
      if (!(Vec3(to.x(), to.y(), cell.z - z).norm() <= reach_))
        continue;  // a place that is none was not felt
      cell.visits = static_cast<std::int16_t>(cell.visits + (sample.t_s - cell.last_s > kAnew_s));
      cell.last_s = sample.t_s;
      cell.level = std::max(cell.level, level);
    }
  }
}

template <class Counts>
double CoverageMap::shareOf(Counts counts) const {
  const auto asked =
      std::count_if(cells_.begin(), cells_.end(), [](const Cell& cell) { return cell.asked; });
  const auto such = std::count_if(cells_.begin(), cells_.end(),
                                  [&](const Cell& cell) { return cell.asked && counts(cell); });
  return static_cast<double>(such) / static_cast<double>(std::max<std::ptrdiff_t>(asked, 1));
}

double CoverageMap::share(int level) const {
  return shareOf([level](const Cell& cell) { return cell.level >= level; });
}

double CoverageMap::twice() const {
  return shareOf([](const Cell& cell) { return cell.visits > 1; });
}

namespace {

constexpr double kMiddle = 0.25;  // of the way from the middle to an edge
constexpr std::array<const char*, 4> kQuarters{"back left", "back right", "front left",
                                               "front right"};

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
      unfelt[quarterOf(map.middle(column, row))] +=
          map.asked(column, row) && map.level(column, row) == 0;
  const int worst = *std::max_element(unfelt.begin(), unfelt.end());
  std::vector<std::string> quarters;
  for (std::size_t i = 0; i < unfelt.size(); ++i)
    if (worst > 0 && 2 * unfelt[i] >= worst) quarters.push_back(kQuarters[i]);
  return quarters;
}

}  // namespace palpa::assess
