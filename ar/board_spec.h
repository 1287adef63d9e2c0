#pragma once

#include <string>
#include <variant>

#include "ar/board.h"
#include "ar/charuco.h"

namespace palpa::ar {

struct ChessboardSpec {
  cv::Size inner_corners;
  double square = 0;       ///< metres
  int half_window_px = 0;  ///< 0: what suits the board
};

struct SingleTagSpec {
  double tag_size = 0;  ///< metres
};

using BoardSpec = std::variant<TagGridSpec, ChessboardSpec, SingleTagSpec, CharucoSpec>;

/// What a word says (see makeBoard). Throws UsageError naming what is known.
BoardSpec parseBoardSpec(const std::string& word);

}  // namespace palpa::ar
