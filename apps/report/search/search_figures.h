#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/report/plot/map_plot.h"

namespace palpa::report {

/// A textured disc, as the task makes it.
struct TexturedDisc {
  MapValues heights;
  double bump_U = 0, grid_U = 0, jitter_U = 0;  ///< radius, spacing, square of a bump's place
};

/// Of an antisymmetric Gabor filter.
struct EdgeFilter {
  MapValues values;  ///< -1 to 1
  double direction_rad = 0, sigma_U = 0, aspect = 0;
};

struct ElementMark {
  double x = 0, y = 0;  ///< U
  bool target = false, chosen = false;
};

/// The probe in one tick.
struct ProbePlace {
  double x = 0, y = 0;  ///< U
  bool touching = false;
  std::uint8_t cues = 0;  ///< bit i: cue i added force
};

/// A floor that was searched in an episode, what the edge filter makes of it, and the probe's way
/// over it. Lengths in U. After Edmunds and Pai (2012), figures 1, 3, 4 and 5.
struct SearchFigures {
  int trial = 0;
  std::string mode;         ///< "degraded"
  double unit_mm = 0;       ///< of one U, in the hand
  MapValues smooth, floor;  ///< without texture, with it
  TexturedDisc target, distractor;
  EdgeFilter filter;
  MapValues response;  ///< of the smooth floor, U
  std::vector<ElementMark> elements;
  std::vector<ProbePlace> way;
  std::vector<std::string> cues;  ///< names, in the order of their bits
};

/// A card of a page: each picture with its caption.
void writeSearchFigures(Html& html, const SearchFigures& figures);
/// CSS of it.
std::string searchFiguresStyle();

/// Each picture as a file of its own (SVG) in a folder that is there, and figures.html, all of them
/// with captions. Returns the names in the order in which they are read.
std::vector<std::string> writeFigureFiles(const SearchFigures& figures,
                                          const std::filesystem::path& folder);

}  // namespace palpa::report
