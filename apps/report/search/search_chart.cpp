#include "apps/report/search/search_sections.h"
#include "apps/training/trial_words.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/report/page/page_parts.h"
#include "apps/report/plot/chart_frame.h"

namespace palpa::report {
namespace {

constexpr double kRowTop = 26, kFoundRow = 46, kCountRoom = 74, kEndCap = 7, kShareDot = 6,
                 kAboveRow = 20;  // px
constexpr double kEpisodeStep = 11, kEpisodesLow = 40, kEpisodesHigh = 190,
                 kEpisodeMark = 4.6;  // px

/// Episodes of one block and mode, in their order.
struct EpisodeRow {
  assess::SearchMode mode;
  std::string block;
  std::vector<assess::SearchTrial> trials;
};

std::vector<EpisodeRow> rowsOf(const std::vector<assess::SearchTrial>& trials) {
  std::vector<EpisodeRow> rows;
  for (const assess::SearchTrial& trial : trials) {
    if (trial.outcome == training::Outcome::voided) continue;
    auto row = std::find_if(rows.begin(), rows.end(), [&](const EpisodeRow& r) {
      return r.mode == trial.mode && r.block == trial.block;
    });
    if (row == rows.end()) row = rows.insert(rows.end(), {trial.mode, trial.block, {}});
    row->trials.push_back(trial);
  }
  return rows;
}

/// In the left margin where there is one, about `middle`; else in a line of its own above `top`.
void drawRowName(Html& html, const ChartFrame& frame, double top, double middle,
                 assess::SearchMode mode, const std::string& block) {
  const std::string words = stiffnessWords(mode);
  if (!frame.wide) {
    svgText(html, "words strong", frame.left, top - 5, words);
    if (!block.empty())
      svgText(html, "words tick", frame.left + 12 + 1.2 * textWidth(words, frame.font), top - 5,
              fitted(block, 140, frame.font));
    return;
  }
  svgText(html, "label strong", 0, middle + (block.empty() ? 4 : -4), words);
  if (!block.empty())
    svgText(html, "tick", 0, middle + 13, fitted(block, frame.left - 12, frame.font));
}

void drawShareRow(Html& html, const assess::SearchTally& tally, const Axis& x, double y) {
  svgLine(html, "whisker", x.at(tally.found_low), y, x.at(tally.found_high), y);
  for (const double end : {tally.found_low, tally.found_high})
    svgLine(html, "whisker", x.at(end), y - kEndCap, x.at(end), y + kEndCap);
  html.empty("circle", {{"class", "dot-share"},
                        {"cx", coordinate(x.at(tally.found_share))},
                        {"cy", coordinate(y)},
                        {"r", coordinate(kShareDot)}});
  svgText(html, "label", x.to_px + 16, y + 4,
          std::to_string(tally.found) + " of " + std::to_string(tally.episodes));
}

void drawFound(Html& html, const std::vector<assess::SearchTally>& tallies,
               const ChartFrame& frame) {
  const double above = frame.wide ? 0 : kAboveRow, row = kFoundRow - (frame.wide ? 0 : 14) + above,
               bottom = kRowTop + row * static_cast<double>(tallies.size());
  const Axis x{0, 1, frame.wide ? frame.left : 14, frame.width - frame.right - kCountRoom};
  ChartFrame names = frame;
  if (!frame.wide) names.left = 14;
  const auto svg = openSvg(html, frame, bottom + 26,
                           "Share of episodes in which the target was found, with 95 % intervals");
  for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    svgLine(html, "grid", x.at(share), kRowTop, x.at(share), bottom);
    svgText(html, "tick mid", x.at(share), bottom + 18, fixed(100 * share, 0) + " %");
  }
  svgLine(html, "by-chance", x.at(1.0 / 3), kRowTop - 6, x.at(1.0 / 3), bottom);
  svgText(html, "tick mid", x.at(1.0 / 3), kRowTop - 11, "by chance");
  for (std::size_t i = 0; i < tallies.size(); ++i) {
    const double top = kRowTop + row * static_cast<double>(i) + above,
                 middle = top + (row - above) / 2;
    drawRowName(html, names, top, middle, tallies[i].mode, tallies[i].block);
    drawShareRow(html, tallies[i], x, middle);
  }
}

double heightOf(const EpisodeRow& row) {
  return std::clamp(kEpisodeStep * static_cast<double>(row.trials.size()) + 12, kEpisodesLow,
                    kEpisodesHigh);
}

void drawEpisodes(Html& html, const EpisodeRow& row, const Axis& x, double top) {
  const double high = heightOf(row), step = (high - 12) / static_cast<double>(row.trials.size());
  if (const double middle = assess::medianSeconds(row.trials); std::isfinite(middle))
    svgLine(html, "median", x.at(middle), top, x.at(middle), top + high);
  for (std::size_t i = 0; i < row.trials.size(); ++i) {
    const assess::SearchTrial& trial = row.trials[i];
    const Tone tone = toneOfEpisode(trial);
    svgPath(html, std::string("mark ") + cssClass(tone) + (assess::counts(trial) ? "" : " hollow"),
            markPath(tone, x.at(trial.seconds), top + 6 + step * (static_cast<double>(i) + 0.5),
                     kEpisodeMark));
  }
}

/// The line above the chart that says what the marks mean.
void drawKey(Html& html, const ChartFrame& frame, double left) {
  double x = left + 6;
  for (const auto& [tone, words] :
       {std::pair{Tone::good, "found"}, std::pair{Tone::bad, "another chosen"},
        std::pair{Tone::guide, "none chosen"}}) {
    svgPath(html, std::string("mark ") + cssClass(tone), markPath(tone, x, 9, kEpisodeMark));
    svgText(html, "legend", x + 11, 13, words);
    x += 11 + textWidth(words, frame.font) + (frame.wide ? 22 : 14);
  }
  svgLine(html, "median", x, 2, x, 16);
  svgText(html, "legend", x + 8, 13, "median");
}

void drawTimes(Html& html, const std::vector<EpisodeRow>& rows, const ChartFrame& frame) {
  const double above = frame.wide ? 0 : kAboveRow, left = frame.wide ? frame.left : 14;
  double longest = 0, bottom = kRowTop;
  for (const EpisodeRow& row : rows) {
    bottom += heightOf(row) + above;
    for (const assess::SearchTrial& trial : row.trials) longest = std::max(longest, trial.seconds);
  }
  ChartFrame names = frame;
  names.left = left;
  const Axis x{0, niceCeiling(longest), left, frame.width - frame.right};
  const auto svg =
      openSvg(html, frame, bottom + 44, "How long each episode took, and how it ended");
  drawKey(html, frame, left);
  double top = kRowTop;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    top += above;
    const double high = heightOf(rows[i]);
    svgRect(html, i % 2 ? "row-back odd" : "row-back", left, top, x.to_px - left, high);
    drawRowName(html, names, top, top + high / 2, rows[i].mode, rows[i].block);
    top += high;
  }
  for (const double value : niceTicks(0, x.to, frame.wide ? 12 : 6).values)
    svgLine(html, "grid", x.at(value), kRowTop + above, x.at(value), bottom);
  top = kRowTop;
  for (const EpisodeRow& row : rows) {
    drawEpisodes(html, row, x, top + above);
    top += heightOf(row) + above;
  }
  drawTimeAxis(html, frame, x, bottom, "time of the episode, s");
}

}  // namespace

Tone toneOfEpisode(const assess::SearchTrial& trial) {
  if (trial.outcome == training::Outcome::voided) return Tone::neutral;
  if (!assess::chose(trial)) return Tone::guide;
  return trial.found() ? Tone::good : Tone::bad;
}

void writeFoundChart(Html& html, const std::vector<assess::SearchTally>& tallies) {
  if (tallies.empty()) return;
  const auto figure = html.in("figure", {{"class", "course"}});
  drawFound(html, tallies, kWide);
  drawFound(html, tallies, kNarrow);
  html.element(
      "figcaption",
      "Share of episodes in which the target was found. The bars are 95 % intervals (Wilson): "
      "where they reach the dashed line, one of three, it may have been chance.");
}

void writeSearchTimes(Html& html, const std::vector<assess::SearchTrial>& trials) {
  const std::vector<EpisodeRow> rows = rowsOf(trials);
  if (rows.empty()) return;
  const auto section = html.in("section", {{"class", "card"}});
  html.element("h2", "How long did it take?");
  const auto figure = html.in("figure", {{"class", "course"}});
  drawTimes(html, rows, kWide);
  drawTimes(html, rows, kNarrow);
  html.element("figcaption",
               "One mark an episode; within a band the first is on top. Circle: the target was "
               "found. Diamond: another element was chosen. Square: none was. Hollow: not scored. "
               "The median is of the episodes with a choice; void ones are left out.");
}

}  // namespace palpa::report
