#include "apps/task_palpation/guidance.h"

#include <algorithm>

namespace palpa::task_palpation {
namespace {

constexpr double kWait_s = 2;
constexpr int kStripCells = 3;  // 12 mm

/// Of a strip's three columns the middle one, where there is one.
int middleOf(int strip, int columns) { return std::min(strip * kStripCells + 1, columns - 1); }

}  // namespace

std::optional<Vec3> nextInStrips(const assess::CoverageMap& map) {
  const int strips = (map.columns() + kStripCells - 1) / kStripCells;
  for (int strip = 0; strip < strips; ++strip) {
    for (int i = 0; i < map.rows(); ++i) {
      const int row = strip % 2 == 0 ? i : map.rows() - 1 - i;
      for (int column = strip * kStripCells;
           column < std::min((strip + 1) * kStripCells, map.columns()); ++column)
        if (map.asked(column, row) && map.level(column, row) == 0) {
          const int middle = middleOf(strip, map.columns());
          return map.middle(map.asked(middle, row) ? middle : column, row);
        }
    }
  }
  return std::nullopt;
}

void Guidance::begin(int trial) {
  helping_ = helps(trial);
  felt_ = felt_at_s_ = last_s_ = shown_s_ = 0;
}

std::optional<Vec3> Guidance::lead(const assess::CoverageMap& map, double t_s) {
  if (!helping_) return std::nullopt;
  if (map.share(1) > felt_) {
    felt_ = map.share(1);
    felt_at_s_ = t_s;
  }
  const double dt = t_s - last_s_;
  last_s_ = t_s;
  if (t_s - felt_at_s_ < kWait_s / support_.amount()) return std::nullopt;
  std::optional<Vec3> next = nextInStrips(map);
  if (next) shown_s_ += dt;
  return next;
}

void Guidance::end(bool covered) {
  helping_ = false;
  support_.end(covered);
}

}  // namespace palpa::task_palpation
