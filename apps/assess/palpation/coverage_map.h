#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/assess/palpation/palpation_sample.h"

namespace palpa::assess {

/// What of an area has been felt, and how firmly. A cell has been felt at a level where the tip
/// pressed at least so hard with its middle within `reach` of the cell's; it has been felt anew
/// where that came back after `kAnew_s` away. One sample at a time: the screen shows the map while
/// it grows, the score reads it at the end. On a curved top the reach is the straight way between
/// two places of it.
class CoverageMap {
 public:
  static constexpr double kCell = 4e-3;  ///< m
  static constexpr double kAnew_s = 3;

  CoverageMap(const SearchArea& area, const PressureLevels& levels, double reach);
  void add(const PalpationSample& sample);

  int columns() const { return columns_; }  ///< along x
  int rows() const { return rows_; }        ///< along y, from the trainee away
  Vec3 middle(int column, int row) const;   ///< of a cell, along the top
  /// It lies in the area's outline: only such cells count.
  bool asked(int column, int row) const { return cells_[index(column, row)].asked; }
  /// 0: not felt, 1 light, 2 medium, 3 deep
  int level(int column, int row) const { return cells_[index(column, row)].level; }
  int visits(int column, int row) const { return cells_[index(column, row)].visits; }

  double share(int level) const;  ///< of the cells asked: felt at this level or a deeper one
  double twice() const;           ///< of the cells felt anew at least once

 private:
  struct Cell {
    std::int16_t level = 0, visits = 0;
    double last_s = -1e9;
    double z = 0;  ///< m, of the top at its middle
    bool asked = true;
  };
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  template <class Counts>
  double shareOf(Counts counts) const;
  SearchArea area_;
  PressureLevels levels_;
  double reach_;
  int columns_, rows_;
  std::vector<Cell> cells_;
};

}  // namespace palpa::assess

/// Places in the words of the trainee, who stands at the front: "back" is away from the trainee,
/// right is right. ("far left" would be read as very much to the left.)
namespace palpa::assess {

/// "back left", "front right", ...; "in the middle" within a quarter of the way to the edges.
std::string placeWords(const SearchArea& area, const Vec3& p_P);

/// The quarters that hold most of what has not been felt: the worst, and those at least half as
/// bad. Empty when all has been felt.
std::vector<std::string> unfeltQuarters(const CoverageMap& map);

}  // namespace palpa::assess
