#include "apps/assess/technique_metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpa::assess {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kDegreesOf = 180 / M_PI;
constexpr double kDrawnBack = 0.003;  // m: less is a tremor, as of redirections
constexpr const char* kErrors[] = {"site",    "landmarks", "periosteum",
                                   "shallow", "cephalad",  "left_vein"};

/// Share of the way toward the vein under suction, %: from each deepest point to the next, so that
/// a way made again does not count again.
double aspiratedAdvance(const TrialReview& r, const ScoringRules& rules) {
  double all = 0, under_suction = 0;
  for (const Pass& pass : r.history.passes) {
    if (!pass.advanced) continue;
    Vec3 deepest_A = r.samples[pass.phase_2].tip_A;
    double deepest = (deepest_A - pass.puncture.tip_A).norm();
    for (std::size_t i = pass.phase_2;
         i <= pass.last && i < r.samples.size() && !inVein(r.samples[i]); ++i) {
      const TrialSample& s = r.samples[i];
      const double reach = (s.tip_A - pass.puncture.tip_A).norm();
      if (reach <= deepest) continue;
      const double way = (s.tip_A - deepest_A).norm();
      all += way;
      if (s.plunger >= rules.plunger_drawn) under_suction += way;
      deepest = reach;
      deepest_A = s.tip_A;
    }
  }
  return all > 0 ? 100 * under_suction / all : kUnknown;
}

/// Largest turn from the direction at the deepest point while the tip goes back from it, rad.
double turnWhileDrawnBack(const TrialReview& r, const Pass& pass) {
  double peak = -1, low = 0, turn = kUnknown;
  Vec3 axis_at_peak = Vec3::UnitZ();
  for (std::size_t i = pass.phase_2; i <= pass.last && i < r.samples.size(); ++i) {
    const TrialSample& s = r.samples[i];
    const double reach = (s.tip_A - pass.puncture.tip_A).norm();
    if (reach > peak || reach > low + kDrawnBack) {  // advanced again: another deepest point
      peak = low = reach;
      axis_at_peak = s.axis_A;
      continue;
    }
    if (reach >= low) continue;
    low = reach;  // going back
    if (peak - reach <= kDrawnBack) continue;
    const double now = angleBetween(s.axis_A, axis_at_peak);
    turn = std::isnan(turn) ? now : std::max(turn, now);
  }
  return turn;
}

double withdrawalTurn(const TrialReview& r) {
  double largest = kUnknown;
  for (const Pass& pass : r.history.passes)
    if (pass.advanced)
      if (const double turn = turnWhileDrawnBack(r, pass); !std::isnan(turn))
        largest = std::isnan(largest) ? turn : std::max(largest, turn);
  return largest;
}

double countOf(const std::vector<Interval>& stretches) {
  return static_cast<double>(stretches.size());
}

}  // namespace

std::vector<metrics::MetricValue> techniqueMetrics(const TrialReview& r,
                                                   const std::vector<TechnicalError>& errors,
                                                   const anatomy::LandmarkFrame& frame,
                                                   const calibration::ExpertPath& path,
                                                   const ScoringRules& rules) {
  const bool advanced = r.pass && r.pass->advanced;
  const Aim aim = advanced ? aimOf(r.pass->start_of_phase_2.axis_A, frame, path) : Aim{};
  const auto where = [&](double millimetres) { return r.entry.punctured ? millimetres : kUnknown; };
  std::vector<metrics::MetricValue> all{
      {"entry_along_mm", where(1e3 * r.entry.offset_L.x())},
      {"entry_across_mm", where(1e3 * r.entry.offset_L.z())},
      {"aim_steeper_deg", advanced ? kDegreesOf * aim.steeper : kUnknown},
      {"aim_cephalad_deg", advanced ? kDegreesOf * aim.more_cephalad : kUnknown},
      {"aspirated_advance_pct", aspiratedAdvance(r, rules)},
      {"withdrawal_turn_deg", kDegreesOf * withdrawalTurn(r)},
      {"pleural_punctures", countOf(r.lung)},
      {"pleural_contacts", countOf(r.lung_touched)},
      {"arterial_punctures",
       countOf(intervals(r.samples,
                         [](const TrialSample& s) { return s.tissue == Tissue::artery_lumen; }))},
      {"arterial_contacts", countOf(r.artery)},
      {"rib_contacts", countOf(r.ribcage)}};
  for (const char* code : kErrors)
    all.push_back({std::string("error_") + code,
                   std::any_of(errors.begin(), errors.end(),
                               [code](const TechnicalError& e) { return e.code == code; })
                       ? 1.0
                       : 0.0});
  return all;
}

}  // namespace palpa::assess
