#include <algorithm>
#include <array>

#include "anatomy/base/counted.h"
#include "apps/assess/palpation/palpation_score.h"
#include "apps/assess/palpation/palpation_words.h"
#include "apps/report/page/page_parts.h"
#include "apps/report/palpation/palpation_charts.h"
#include "apps/report/plot/chart_frame.h"
#include "apps/report/plot/path_data.h"

namespace palpa::report {
namespace {

constexpr double kArm = 7;  // px, of a cross

std::string placed(double x, double y) { return 'M' + coordinate(x) + ' ' + coordinate(y); }

void drawCircle(Html& svg, const char* css, double x, double y, double radius) {
  svg.empty(
      "circle",
      {{"class", css}, {"cx", coordinate(x)}, {"cy", coordinate(y)}, {"r", coordinate(radius)}});
}

}  // namespace

std::string cellPath(double x, double y, double width, double height) {
  return placed(x, y) + 'h' + coordinate(width) + 'v' + coordinate(height) + 'h' +
         coordinate(-width) + 'z';
}

std::string pipsPath(int level, double x, double y, double step) {
  std::string path;
  for (int i = 0; i < level; ++i) path += placed(x + (i - (level - 1) / 2.0) * step, y) + "h0";
  return path;
}

void drawLumpRing(Html& svg, double x, double y, double radius, bool found) {
  drawCircle(svg, "halo", x, y, radius);
  drawCircle(svg, found ? "ring found" : "ring missed", x, y, radius);
}

void drawMarkSign(Html& svg, double x, double y, bool false_alarm) {
  const std::string two = coordinate(2 * kArm);
  std::string path = placed(x - kArm, y - kArm) + 'l' + two + ' ' + two + 'm' + "0-" + two + 'l' +
                     '-' + two + ' ' + two;
  if (false_alarm) path += placed(x - kArm - 3, y - kArm - 3) + "h20v20h-20z";
  svgPath(svg, "halo", path);
  svgPath(svg, false_alarm ? "cross alarm" : "cross", path);
}

namespace {

constexpr double
    kAround = 26,
    kUnder = 66;  // px about the area: what reaches beyond it, and scale bar and words below

/// Where the area lies in the picture.
struct MapFrame {
  double left, top, width, height;  // px
  double scale;                     // px per m
  double x(const Vec3& p) const {
    return std::clamp(left + width / 2 + scale * p.x(), left - kAround, left + width + kAround);
  }
  double y(const Vec3& p) const {
    return std::clamp(top + height / 2 - scale * p.y(), top - kAround, top + height + kAround);
  }
};

MapFrame mapFrame(const assess::SearchArea& area, const ChartFrame& frame) {
  const double half_x = std::max(area.half_x, 1e-3), half_y = std::max(area.half_y, 1e-3),
               room = frame.wide ? 480 : frame.width - 2 * kAround;
  const double scale = room / (2 * std::max(half_x, half_y));
  return {kAround, 24 + kAround, 2 * half_x * scale, 2 * half_y * scale, scale};
}

assess::CoverageMap coverageOf(const PalpationPage& page) {
  assess::CoverageMap map(page.rules.area, page.rules.levels, page.rules.reach);
  for (const assess::PalpationSample& sample : page.samples)
    if (sample.p_P.allFinite()) map.add(sample);
  return map;
}

/// One path a level: hundreds of rectangles would make a large page.
void drawCells(Html& svg, const MapFrame& at, const assess::CoverageMap& map) {
  const double width = at.width / map.columns(), height = at.height / map.rows();
  for (int level = 0; level <= static_cast<int>(assess::kPressureLevels); ++level) {
    std::string cells, pips;
    for (int row = 0; row < map.rows(); ++row) {
      for (int column = 0; column < map.columns(); ++column) {
        if (map.level(column, row) != level || !map.asked(column, row)) continue;
        const Vec3 middle = map.middle(column, row);
        cells += cellPath(at.x(middle) - width / 2, at.y(middle) - height / 2, width, height);
        pips += pipsPath(level, at.x(middle), at.y(middle), std::min(width, height) / 4);
      }
    }
    if (!cells.empty()) svgPath(svg, "cell level-" + std::to_string(level), cells);
    if (!pips.empty()) svgPath(svg, "pips level-" + std::to_string(level), pips);
  }
}

/// Of the area: a rectangle, or its outline.
void drawEdge(Html& svg, const MapFrame& at, const assess::SearchArea& area) {
  if (area.outline.empty()) return svgRect(svg, "edge", at.left, at.top, at.width, at.height);
  PathData path;
  for (const Eigen::Vector2d& corner : area.outline) {
    const Vec3 p(corner.x(), corner.y(), 0);
    path.lineTo(at.x(p), at.y(p));
  }
  path.close();
  svgPath(svg, "edge", path.str());
}

constexpr double kContour = 2e-3;  // m, from one line of equal height to the next

/// Where one side of a cell crosses a height; two of them make a piece of its line.
void addContour(PathData& path, const MapFrame& at, const std::array<Vec3, 3>& corners,
                double height) {
  bool begun = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &a = corners[i], &b = corners[(i + 1) % 3];
    if ((a.z() < height) == (b.z() < height)) continue;
    const Vec3 p = a + (height - a.z()) / (b.z() - a.z()) * (b - a);
    if (begun)
      path.lineTo(at.x(p), at.y(p));
    else
      path.moveTo(at.x(p), at.y(p));
    begun = true;
  }
}

/// Lines of equal height of a curved top, as a map of hills has them.
void drawContours(Html& svg, const MapFrame& at, const assess::SearchArea& area) {
  constexpr int kParts = 24;  // along each side
  if (area.top.flat()) return;
  const auto on = [&](int i, int j) {
    return assess::onTop(
        area, Vec3(area.half_x * (2.0 * i / kParts - 1), area.half_y * (2.0 * j / kParts - 1), 0));
  };
  PathData path;
  for (int i = 0; i < kParts; ++i) {
    for (int j = 0; j < kParts; ++j) {
      for (const auto& half : {std::array{on(i, j), on(i + 1, j), on(i + 1, j + 1)},
                               std::array{on(i, j), on(i + 1, j + 1), on(i, j + 1)}}) {
        const auto [low, high] = std::minmax({half[0].z(), half[1].z(), half[2].z()});
        for (double k = std::ceil(low / kContour); k * kContour <= high; ++k)
          addContour(path, at, half, k * kContour);
      }
    }
  }
  if (const std::string lines = path.str(); !lines.empty()) svgPath(svg, "contour", lines);
}

std::string linePath(const MapFrame& at, const assess::NormalAnatomy& normal) {
  PathData path;
  for (const Vec3& p : normal.line_P) path.lineTo(at.x(p), at.y(p));
  return path.str();
}

/// A broad band with its middle line, no farther than the map, and its name where it begins.
void drawNormal(Html& svg, const MapFrame& at, const assess::PalpationRules& rules) {
  for (const assess::NormalAnatomy& normal : rules.normal) {
    if (normal.line_P.empty()) continue;
    const std::string path = linePath(at, normal), x = coordinate(at.left), y = coordinate(at.top),
                      width = coordinate(at.width), height = coordinate(at.height);
    {
      const auto map = svg.in("svg", {{"x", x},
                                      {"y", y},
                                      {"width", width},
                                      {"height", height},
                                      {"viewBox", x + ' ' + y + ' ' + width + ' ' + height}});
      svg.empty("path", {{"class", "normal"},
                         {"d", path},
                         {"stroke-width", coordinate(at.scale * normal.width)}});
      svgPath(svg, "normal-line", path);
    }
    svgText(svg, "words", at.x(normal.line_P.front()) - 6, at.y(normal.line_P.front()) - 8,
            normal.name);
  }
}

void drawLumps(Html& svg, const MapFrame& at, const assess::PalpationAssessment& trial) {
  for (std::size_t i = 0; i < trial.lumps.size(); ++i) {
    const assess::CaseLump& lump = trial.lumps[i];
    if (!lump.p_P.allFinite()) continue;
    const double x = at.x(lump.p_P), y = at.y(lump.p_P),
                 r = std::max(2.0, at.scale * lump.diameter / 2);
    drawLumpRing(svg, x, y, r, i < trial.score.lumps.size() && trial.score.lumps[i].mark >= 0);
    svgText(svg, "words strong mid", x - 0.71 * r - 9, y - 0.71 * r - 3, lumpName(i));
  }
}

void drawMarks(Html& svg, const MapFrame& at, const PalpationPage& page) {
  const assess::PalpationAssessment& trial = page.assessment;
  for (std::size_t i = 0; i < trial.marks.size(); ++i) {
    const Vec3& p_P = trial.marks[i].p_P;
    if (!p_P.allFinite()) continue;
    const bool alarm = assess::meaningOf(i, page.rules, trial.score, trial.lumps, trial.marks) ==
                       assess::MarkMeaning::false_alarm;
    drawMarkSign(svg, at.x(p_P), at.y(p_P), alarm);
    svgText(svg, "words strong", at.x(p_P) + 12, at.y(p_P) + 14, std::to_string(i + 1));
  }
}

void drawSurroundings(Html& svg, const MapFrame& at) {
  const double middle = at.left + at.width / 2, below = at.top + at.height + kAround;
  svgText(svg, "legend mid", middle, 18, "away from you");
  svgText(svg, "legend mid", middle, below + 12, "toward you");
  const double bar = 0.01 * at.scale, y = below + 24;
  svgPath(svg, "bar-10mm",
          "M" + coordinate(at.left) + ' ' + coordinate(y - 5) + "v10m0-5h" + coordinate(bar) +
              "m0-5v10");
  svgText(svg, "legend", at.left + bar + 10, y + 5, "10 mm");
}

void drawMapLegend(Html& svg, const assess::PressureLevels& levels, double x, double top) {
  double y = top;
  const std::array<std::string, 4> felt{"not felt",
                                        "felt lightly: " + trimmed(levels[0], 2) + " N or more",
                                        "medium: " + trimmed(levels[1], 2) + " N or more",
                                        "deep: " + trimmed(levels[2], 2) + " N or more"};
  for (int level = 0; level < 4; ++level, y += 32) {
    svgPath(svg, "cell level-" + std::to_string(level), cellPath(x, y - 12, 24, 24));
    if (level > 0)
      svgPath(svg, "pips level-" + std::to_string(level), pipsPath(level, x + 12, y, 6));
    svgText(svg, "label", x + 38, y + 5, felt[static_cast<std::size_t>(level)]);
  }
  for (const bool found : {true, false}) {
    drawLumpRing(svg, x + 12, y, 11, found);
    svgText(svg, "label", x + 38, y + 5,
            found ? "lump A, B, ..., found; its true size" : "lump, missed");
    y += 32;
  }
  for (const bool alarm : {false, true}) {
    drawMarkSign(svg, x + 12, y, alarm);
    svgText(
        svg, "label", x + 38, y + 5,
        alarm ? "false alarm: a mark where no lump is" : "mark 1, 2, ..., in the order of marking");
    y += 32;
  }
}

void drawMap(Html& html, const PalpationPage& page, const assess::CoverageMap& map,
             const ChartFrame& frame) {
  const MapFrame at = mapFrame(page.rules.area, frame);
  const assess::PalpationScore& score = page.assessment.score;
  const double height = at.top + at.height + kUnder, legend = 8 * 32;
  const auto svg =
      openSvg(html, frame, frame.wide ? std::max(height, at.top + legend) : height + legend,
              "The searched area from above: " + assess::percentWords(map.share(1)) + " felt, " +
                  assess::percentWords(map.share(3)) + " deeply; " + counted(score.found, "lump") +
                  " found, " + std::to_string(score.missed) + " missed, " +
                  counted(score.false_alarms, "false alarm"));
  drawCells(html, at, map);
  drawContours(html, at, page.rules.area);
  drawEdge(html, at, page.rules.area);
  drawNormal(html, at, page.rules);
  drawLumps(html, at, page.assessment);
  drawMarks(html, at, page);
  drawSurroundings(html, at);
  if (frame.wide)
    drawMapLegend(html, page.rules.levels, at.left + at.width + kAround + 40, at.top + 14);
  else
    drawMapLegend(html, page.rules.levels, at.left, height + 10);
}

}  // namespace

std::string lumpName(std::size_t index) {
  return index < 26 ? std::string(1, static_cast<char>('A' + index))
                    : "L" + std::to_string(index + 1);
}

void writeCoverageChart(Html& html, const PalpationPage& page) {
  const assess::CoverageMap map = coverageOf(page);
  const auto figure = html.in("figure");
  drawMap(html, page, map, kWide);
  drawMap(html, page, map, kNarrow);
  if (!page.rules.area.top.flat())
    html.element("figcaption", "Thin lines join places of equal height, " +
                                   fixed(1e3 * kContour, 0) + " mm from line to line.");
  if (page.samples.empty()) html.element("figcaption", "No motion was recorded in this trial.");
}

}  // namespace palpa::report
