#pragma once

#include <vector>

#include "apps/station/station_file.h"

namespace palpa::twin {

/// A push that a board on the table gets: "twin/board_moves" of a station's file, a list of
/// {"board", "from_s", "by_mm"}; session time.
struct BoardMove {
  std::size_t board = 0;   ///< of the station's other boards
  double from = 0;         ///< s
  Vec3 by = Vec3::Zero();  ///< m, in W
};

/// Throws UsageError for a board that the station has not, or that belongs nowhere.
std::vector<BoardMove> readBoardMoves(const station::Station& station);

/// Where the station's boards that belong somewhere truly are at a time, in W, each with its index.
std::vector<std::pair<std::size_t, Pose>> boardsAt(const station::Station& station,
                                                   const std::vector<BoardMove>& moves, double t);

}  // namespace palpa::twin
