#include "apps/report/needle/trial_sections.h"
#include "apps/training/trial_words.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "apps/report/page/page_parts.h"
#include "apps/report/plot/chart_frame.h"
#include "apps/report/plot/svg_plot.h"

namespace palpa::report {
namespace {

using assess::TrialAssessment;

bool counts(const TrialAssessment& trial) {
  return trial.outcome != training::Outcome::voided && !trial.penalties.empty() &&
         std::isfinite(trial.total);
}

/// Circle: success; square: with a complication; diamond: no success; hollow: not a scored trial.
void drawTrial(Html& svg, const TrialAssessment& trial, double x, double y) {
  const bool scored = trial.role == training::Role::none || training::countsAsScored(trial.role);
  const Tone tone = toneOfOutcome(trial);
  svgPath(svg, std::string("mark ") + cssClass(tone) + (scored ? "" : " hollow"),
          markPath(tone, x, y, 6.5));
}

void drawTotals(Html& html, const std::vector<TrialPage>& trials, const ChartFrame& frame) {
  constexpr double kTop = 24, kHeight = 170;
  double high = 0;
  for (const auto& page : trials) {
    if (counts(page.assessment)) high = std::max(high, page.assessment.total);
  }
  const Axis x = frame.across(0.5, static_cast<double>(trials.size()) + 0.5);
  PlotPanel panel{
      frame.wide ? "Total" : "Total penalty", "points", {}, niceCeiling(high), 0, kHeight};
  PlotCurve curve{"total", "totals", {}, false};
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (counts(trials[i].assessment)) {
      curve.points.push_back({static_cast<double>(i + 1), trials[i].assessment.total});
    }
  }
  panel.curves.push_back(curve);
  const auto svg = openSvg(html, frame, kTop + kHeight + 44, "Total penalty of each trial, points");
  drawPanel(html, frame, x, kTop, panel);
  if (frame.wide) svgText(html, "legend", 0, kTop + 31, "lower is better");
  const Axis y{panel.y_top, panel.y_bottom, kTop, kTop + kHeight};
  const std::size_t every =
      1 + trials.size() * (frame.wide ? 30 : 28) / static_cast<std::size_t>(x.to_px - x.from_px);
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const TrialAssessment& trial = trials[i].assessment;
    const double px = x.at(static_cast<double>(i + 1));
    if (counts(trial)) drawTrial(html, trial, px, y.at(trial.total));
    if (i % every == 0)
      svgText(html, "tick mid", px, kTop + kHeight + 20, std::to_string(trial.trial));
  }
  svgText(html, "label mid", (x.from_px + x.to_px) / 2, kTop + kHeight + 40, "trial");
}

void writeLegend(Html& html) {
  html.element("figcaption",
               "Circle: successful. Square: vein reached, with a complication (lung or artery). "
               "Diamond: not "
               "successful. Hollow: familiarisation or demonstration. "
               "Void trials are left out.");
}

std::string distance(double mm, double t_s) { return mm == 0 && t_s == 0 ? "–" : fixed(mm, 1); }

/// Columns under a common heading; `names` empty: the heading is the column.
struct ColumnGroup {
  const char* heading;
  std::vector<const char*> names;
};

const std::vector<ColumnGroup>& groups() {
  static const std::vector<ColumnGroup> kGroups{
      {"Trial", {}},
      {"Outcome", {}},
      {"Force", {}},
      {"Total", {}},
      {"Time", {}},
      {"Contacts, samples", {"lung", "ribs", "artery", "vein"}},
      {"Entry", {}},
      {"Direction", {}},
      {"Path", {"mean", "var."}},
      {"Number", {"skin", "redir."}},
      {"Closest, mm", {"pleura", "artery"}}};
  return kGroups;
}

void writeTableHead(Html& html) {
  const auto head = html.in("thead");
  {
    const auto row = html.in("tr");
    for (const ColumnGroup& group : groups()) {
      if (group.names.empty()) {
        html.element("th", {{"scope", "col"}, {"rowspan", "2"}}, group.heading);
      } else {
        html.element("th", {{"scope", "colgroup"}, {"colspan", std::to_string(group.names.size())}},
                     group.heading);
      }
    }
  }
  const auto row = html.in("tr");
  for (const ColumnGroup& group : groups()) {
    for (const char* name : group.names) html.element("th", {{"scope", "col"}}, name);
  }
}

void writeOutcome(Html& html, const TrialAssessment& trial) {
  const auto cell = html.in("td", {{"class", "words"}});
  const bool scored = trial.role == training::Role::none || training::countsAsScored(trial.role);
  html.element("span", {{"class", std::string("dot ") + cssClass(toneOfOutcome(trial))}},
               shortOutcome(trial) + (scored ? "" : ", " + training::nameOf(trial.role)));
}

void writeRow(Html& html, const TrialAssessment& t) {
  const auto& v = t.values;
  const auto row = html.in("tr");
  {
    const auto cell = html.in("th", {{"scope", "row"}});
    html.element("a", {{"href", "#trial-" + std::to_string(t.trial)}}, std::to_string(t.trial));
  }
  writeOutcome(html, t);
  for (const std::string& text :
       {std::string(t.force_feedback ? "on" : "off"), counts(t) ? fixed(t.total, 1) : "–",
        fixed(v.time_ms / 1000, 1), trimmed(v.col_lung, 0), trimmed(v.col_rib, 0),
        trimmed(v.col_art, 0), trimmed(v.col_vein, 0), fixed(v.phase_1, 1), fixed(v.phase_2, 0),
        fixed(v.econ_mean, 1), fixed(v.econ_var, 1), std::to_string(t.skin_punctures),
        std::to_string(t.redirections), distance(t.closest_pleura_mm, t.closest_pleura_s),
        distance(t.closest_artery_mm, t.closest_artery_s)}) {
    html.element("td", text);
  }
}

/// Of a task with a goal of its own.
void writeGoalTable(Html& html, const std::vector<TrialPage>& trials) {
  const auto table = html.in("table", {{"class", "all"}});
  {
    const auto head = html.in("thead"), row = html.in("tr");
    for (const char* name : {"Trial", "Outcome", "Force feedback", "Time, s"})
      html.element("th", {{"scope", "col"}}, name);
  }
  const auto body = html.in("tbody");
  for (const TrialPage& page : trials) {
    const TrialAssessment& t = page.assessment;
    const auto row = html.in("tr");
    html.element("th", {{"scope", "row"}}, std::to_string(t.trial));
    writeOutcome(html, t);
    html.element("td", t.force_feedback ? "on" : "off");
    html.element("td", fixed(t.values.time_ms / 1000, 1));
  }
}

void writeTable(Html& html, const std::vector<TrialPage>& trials) {
  const auto scroll = html.in("div", {{"class", "scroll"}, {"tabindex", "0"}});
  const auto table = html.in("table", {{"class", "all"}});
  writeTableHead(html);
  const auto body = html.in("tbody");
  for (const TrialPage& page : trials) writeRow(html, page.assessment);
}

}  // namespace

void writeOverview(Html& html, const std::vector<TrialPage>& trials) {
  if (trials.size() < 2) return;
  const auto section = html.in("section", {{"class", "card"}, {"id", "all-trials"}});
  html.element("h2", "All trials");
  if (!trials.front().assessment.by_path) return writeGoalTable(html, trials);
  {
    const auto figure = html.in("figure");
    drawTotals(html, trials, kWide);
    drawTotals(html, trials, kNarrow);
    writeLegend(html);
  }
  writeTable(html, trials);
  html.element(
      "p", {{"class", "muted small"}},
      "Force: force feedback. Total: penalty points, lower is better. Time: s. Contacts: scoring "
      "samples, 20 a second. Entry: mm. Direction: 1000 is as far as experts vary. Path: "
      "distance from the optimal line, mean in mm, variance in mm². Number: skin punctures, "
      "redirections.");
}

}  // namespace palpa::report
