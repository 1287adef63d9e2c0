#pragma once

#include <string>
#include <variant>

#include "ar/boards/board.h"
#include "ar/boards/charuco.h"

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

/// Kalibr's description of a target, "key: value  # comment" lines: target_type 'aprilgrid',
/// tagCols, tagRows, tagSize (metres), tagSpacing (gap over tag size). Kalibr prints borders two
/// cells wide and ids from 0. Throws Error with `where` and the key that is missing, wrong or
/// unknown; other target types are refused.
TagGridSpec parseKalibrTarget(const std::string& text, const std::string& where);

}  // namespace palpa::ar
