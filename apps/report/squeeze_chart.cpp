#include "apps/report/squeeze_chart.h"

#include <cmath>

#include "apps/assess/statistics/wilson.h"
#include "apps/report/chart_frame.h"
#include "apps/report/numbers.h"

namespace palpa::report {
namespace {

constexpr double kTop = 16, kHigh = 170, kDot = 6, kWhisker = 7;  // px

void drawShares(Html& html, const assess::Discrimination& answers, const char* what,
                const ChartFrame& frame) {
  const auto svg = openSvg(html, frame, kTop + kHigh + 46,
                           std::string("Share of right answers to which one was ") + what);
  const Axis y{0, 1, kTop + kHigh, kTop};
  const double left = frame.left, right = frame.width - frame.right,
               column = (right - left) / static_cast<double>(answers.shares.size());
  for (const double share : {0.0, 0.5, 1.0}) {
    svgLine(html, share == 0.5 ? "threshold level-2" : "grid", left, y.at(share), right,
            y.at(share));
    svgText(html, "words end", left - 8, y.at(share) + 4, fixed(100 * share, 0) + " %");
  }
  svgText(html, "words end", right, y.at(0.5) - 5, "chance");
  for (std::size_t i = 0; i < answers.shares.size(); ++i) {
    const assess::SharesAtRatio& share = answers.shares[i];
    const statistics::ShareInterval interval = statistics::wilson(share.right, share.of);
    const double x = left + (static_cast<double>(i) + 0.5) * column;
    svgLine(html, "whisker", x, y.at(interval.low), x, y.at(interval.high));
    for (const double end : {interval.low, interval.high})
      svgLine(html, "whisker", x - kWhisker, y.at(end), x + kWhisker, y.at(end));
    html.empty("circle", {{"class", "dot-share"},
                          {"cx", coordinate(x)},
                          {"cy", coordinate(y.at(interval.share))},
                          {"r", coordinate(kDot)}});
    svgText(html, "words mid", x, y.from_px + 18, percentMore(share.ratio));
    svgText(html, "words mid", x, y.from_px + 34,
            std::to_string(share.right) + " of " + std::to_string(share.of));
  }
}

}  // namespace

std::string percentMore(double ratio) { return fixed(100 * (ratio - 1), 0) + " %"; }

void writeSqueezeChart(Html& html, const assess::Discrimination& answers, const char* what) {
  if (answers.shares.empty()) return;
  const auto figure = html.in("figure", {{"class", "course"}});
  drawShares(html, answers, what, kWide);
  drawShares(html, answers, what, kNarrow);
  html.element("figcaption", std::string("Right answers by how much ") + what +
                                 " the one was; the bars are 95 % intervals (Wilson): where they "
                                 "reach below the dotted line, it may have been chance.");
}

}  // namespace palpa::report
