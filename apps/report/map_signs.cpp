#include "apps/report/map_signs.h"

#include "apps/report/chart_frame.h"
#include "apps/report/numbers.h"

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

}  // namespace palpa::report
