#include "apps/report/near_miss.h"

#include <algorithm>
#include <cmath>

#include "apps/report/chart_frame.h"
#include "apps/report/numbers.h"

namespace palpa::report {
namespace {

constexpr Axis kScale{-5, 20, 12, 308};  // mm on px; wider distances stand at the edge
constexpr double kClose_mm = 3;          // said as "close" in words; ours, no clinical limit

std::string verdict(double distance_mm) {
  if (distance_mm < 0) return "inside";
  return distance_mm < kClose_mm ? "very close" : "clear";
}

void drawScale(Html& html, const std::string& organ, double distance_mm) {
  const std::string label =
      "Distance of the tip from the " + organ + ": " + fixed(distance_mm, 1) + " mm";
  const auto svg = html.in(
      "svg",
      {{"class", "scale"}, {"viewBox", "0 0 320 46"}, {"role", "img"}, {"aria-label", label}});
  svgRect(html, "inside-organ", kScale.at(-5), 8, kScale.at(0) - kScale.at(-5), 12);
  svgRect(html, "lane", kScale.at(0), 8, kScale.at(20) - kScale.at(0), 12);
  svgLine(html, "wall", kScale.at(0), 4, kScale.at(0), 24);
  for (const double value : {-5.0, 0.0, 5.0, 10.0, 15.0, 20.0}) {
    svgText(html, "tick mid", kScale.at(value), 40, fixed(value, 0));
  }
  const double x = kScale.at(std::clamp(distance_mm, kScale.from, kScale.to));
  html.empty("circle", {{"class", distance_mm < 0 ? "mark bad" : "mark plain"},
                        {"cx", coordinate(x)},
                        {"cy", "14"},
                        {"r", "7"}});
}

void writeOne(Html& html, const char* title, const std::string& organ, double distance_mm,
              double t_s) {
  const auto box = html.in("div", {{"class", "miss"}});
  html.element("h4", title);
  // Zero at time zero is how an assessment leaves them when nothing was measured.
  if (!std::isfinite(distance_mm) || (distance_mm == 0 && t_s == 0)) {
    html.element("p", {{"class", "muted"}}, "not measured");
    return;
  }
  {
    const auto line = html.in("p");
    html.element("strong", fixed(distance_mm, 1) + " mm");
    html.element("span", {{"class", distance_mm < 0 ? "badge bad" : "badge"}},
                 verdict(distance_mm));
    html.element("span", {{"class", "muted"}}, "at " + fixed(t_s, 1) + " s");
  }
  drawScale(html, organ, distance_mm);
}

}  // namespace

void writeNearMisses(Html& html, const assess::TrialAssessment& assessment) {
  html.element("h3", "Near misses");
  {
    const auto row = html.in("div", {{"class", "misses"}});
    writeOne(html, "Closest to the pleura", "pleura", assessment.closest_pleura_mm,
             assessment.closest_pleura_s);
    writeOne(html, "Closest to the artery", "artery", assessment.closest_artery_mm,
             assessment.closest_artery_s);
  }
  html.element("p", {{"class", "muted small"}},
               "Distance of the needle's tip from the wall, mm. Negative: the tip was inside.");
}

}  // namespace palpa::report
