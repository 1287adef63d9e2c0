#pragma once

#include <filesystem>
#include <string>

#include "ar/boards/sheet.h"

namespace palpa::report {

/// What a board is printed on.
struct BoardPage {
  /// a4, a3, a2, a1, letter, tabloid; "fit": as large as board and scale bar need
  std::string paper = "a4";
  std::string words;  ///< which board it is, below it
  int dpi = 300;      ///< of a PNG
};

/// The papers' names.
const std::vector<std::string>& papers();

struct PageSize {
  double width_mm = 0, height_mm = 0;
};

/// Draws the board in its true size in the middle of a page, upright or across, whichever holds it,
/// with bars of 100 mm along both sides to be measured after printing. A PDF holds it as lines, a
/// PNG as pixels; the ending of `file` says which. Written beside, then renamed. Throws UsageError
/// for a board that the paper does not hold or another ending, Error where nothing can be written.
PageSize writeBoardPage(const ar::Sheet& sheet, const BoardPage& page,
                        const std::filesystem::path& file);

}  // namespace palpa::report
