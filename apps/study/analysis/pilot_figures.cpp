#include <algorithm>

#include "apps/study/analysis/exhibit.h"
#include "apps/study/analysis/pilot.h"

namespace palpa::study_analysis {
namespace {

/// Mean over subjects of each trial's number, with its interval.
PlotSeries curveOf(const std::vector<SubjectSeries>& cell, const std::string& label, int family) {
  PlotSeries curve{label, family, {}};
  int last = 0;
  for (const SubjectSeries& s : cell) last = std::max(last, s.trials.back());
  for (int trial = 1; trial <= last; ++trial) {
    std::vector<double> values;
    for (const SubjectSeries& s : cell)
      for (std::size_t i = 0; i < s.trials.size(); ++i)
        if (s.trials[i] == trial) values.push_back(s.values[i]);
    if (!values.empty()) curve.points.push_back(meanPoint(trial, values));
  }
  return curve;
}

Exhibit curveExhibit(const std::vector<StudyRow>& rows, const StudyDesign& design,
                     const std::vector<std::string>& conditions, const std::string& metric,
                     const std::string& group, const std::string& id) {
  Exhibit e{id,
            "Trial by trial: " + metricTitle(metric) + ", " + inWords(design, group),
            "Mean over subjects for each trial, with its 95 % interval (Student's t). Wide bands "
            "come from few subjects.",
            ExhibitPart::figure,
            {{{"condition", "Condition", 0},
              {"trial", "Trial", 0},
              {"mean", "Mean", 2},
              {"low", "95 % from", 2},
              {"high", "to", 2}},
             {}},
            {},
            {}};
  Plot plot{PlotKind::curves, "trial", metricTitle(metric), {}, {}, {}, {}};
  const std::vector<SubjectSeries> series = seriesOf(rows, metric);
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    plot.families.push_back(inWords(design, conditions[c]));
    plot.series.push_back(
        curveOf(within(series, group, conditions[c]), plot.families.back(), static_cast<int>(c)));
    for (const PlotPoint& p : plot.series.back().points)
      e.table.rows.push_back({plot.families.back(), p.x, p.y, p.low, p.high});
  }
  e.plots.push_back(std::move(plot));
  return e;
}

Plot barPlot(const std::vector<StudyRow>& rows, const StudyDesign& design, const Pilot& pilot,
             const std::string& metric, Table& table) {
  Plot plot{PlotKind::bars, "", metricTitle(metric), {}, {}, {}, {}};
  const std::vector<SubjectSeries> series = seriesOf(rows, metric);
  for (const std::string& condition : pilot.conditions)
    plot.x_names.push_back(inWords(design, condition));
  for (const std::string& group : groupsOf(rows, design)) {
    PlotSeries bars{inWords(design, group), static_cast<int>(plot.families.size()), {}};
    plot.families.push_back(bars.label);
    for (std::size_t c = 0; c < pilot.conditions.size(); ++c) {
      const std::vector<double> means = subjectMeans(within(series, group, pilot.conditions[c]));
      if (means.empty()) continue;
      bars.points.push_back(meanPoint(static_cast<double>(c), means));
      const PlotPoint& p = bars.points.back();
      table.rows.push_back({metricTitle(metric), bars.label, plot.x_names[c],
                            static_cast<double>(means.size()), p.y, p.low, p.high});
    }
    plot.series.push_back(std::move(bars));
  }
  return plot;
}

Exhibit barExhibit(const std::vector<StudyRow>& rows, const StudyDesign& design,
                   const Pilot& pilot) {
  Exhibit e{"figure_6",
            "Groups and conditions",
            "Mean over subjects of all their trials, with its 95 % interval (Student's t).",
            ExhibitPart::figure,
            {{{"figure", "Figure", 0},
              {"group", "Group", 0},
              {"condition", "Condition", 0},
              {"n", "Subjects", 0},
              {"mean", "Mean", 2},
              {"low", "95 % from", 2},
              {"high", "to", 2}},
             {}},
            {},
            {}};
  for (const std::string& metric : kPilotMetrics) {
    Plot plot = barPlot(rows, design, pilot, metric, e.table);
    const bool some = std::any_of(plot.series.begin(), plot.series.end(),
                                  [](const PlotSeries& s) { return !s.points.empty(); });
    if (some) e.plots.push_back(std::move(plot));
  }
  return e;
}

}  // namespace

std::vector<Exhibit> pilotFigures(const std::vector<StudyRow>& rows, const StudyDesign& design,
                                  const Pilot& pilot) {
  std::vector<Exhibit> all;
  const auto curves = [&](const std::string& group, const std::string& suffix) {
    for (const auto& [metric, id] :
         {std::pair{"total", "figure_4"}, std::pair{"time_s", "figure_5"}}) {
      Exhibit e = curveExhibit(rows, design, pilot.conditions, metric, group, id + suffix);
      if (!e.table.rows.empty()) all.push_back(std::move(e));
    }
  };
  curves(pilot.learners, "");
  if (!pilot.experts.empty()) curves(pilot.experts, "_second_group");
  all.push_back(barExhibit(rows, design, pilot));
  return all;
}

}  // namespace palpa::study_analysis
