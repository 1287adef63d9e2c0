#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/report/plot/chart_frame.h"

namespace palpa::report {

/// A quantity over a rectangle: rows from the smallest y on, in each from the smallest x; a value
/// stands for its pixel's middle.
struct MapValues {
  int columns = 0, rows = 0;
  double x_from = 0, x_to = 1, y_from = 0, y_to = 1;
  std::vector<float> values;
};

/// How it is drawn: from -`largest` (dark blue) over 0 (white) to `largest` (dark orange), a pair
/// of hues that every kind of colour vision tells apart; the bar beside it shows `from` to `to` of
/// them.
struct MapPlot {
  MapValues map;
  std::string label;         ///< for those who do not see it
  std::string unit;          ///< of the axes
  std::string quantity;      ///< of the bar, with its unit: "height, U"
  double from = -1, to = 1;  ///< of the bar
  double largest = 1;        ///< > 0
  double foot_px = 0;        ///< room below the axis for what `over` draws there, from kMapFoot on
};

inline constexpr double kMapFoot = 52;  ///< px: of ticks and title below the map

/// "#rrggbb" of a value; beyond the largest as there, "#808080" for what is no number.
std::string mapColour(double value, double largest);

/// The map as a PNG picture, north up: a pixel a value. Throws Error for a map whose size is not
/// that of its values.
std::string mapPng(const MapValues& map, double largest);

/// An SVG picture of its own: the map with frame, axes and bar. `over` draws on it, given its axes.
using DrawOver = std::function<void(Html& svg, const Axis& x, const Axis& y)>;
void drawMap(Html& html, const MapPlot& plot, const DrawOver& over = {});

/// The same as a whole SVG file, which needs no page around it; `style` is CSS of what `over`
/// draws.
std::string mapFile(const MapPlot& plot, const DrawOver& over = {}, const std::string& style = "");

}  // namespace palpa::report
