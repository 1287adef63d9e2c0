#include "apps/assess/needle/needle_metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "apps/assess/metrics/curve_distance.h"
#include "apps/assess/metrics/motion.h"

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
                                                   const calibration::TaughtPath& path,
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

namespace {

using metrics::MetricValue;

constexpr double kDoesNotApply = std::numeric_limits<double>::quiet_NaN();
constexpr double kBeforeVein_s = 0.2;
constexpr double kDegrees = 180 / std::numbers::pi;

metrics::Motion motionIn(Samples samples) {
  std::vector<metrics::RawSample> raw;
  for (const TrialSample& s : samples)
    raw.push_back({s.t_s, s.tip_A, s.axis_A,
                   s.phase == haptics::NeedlePhase::inserted ? s.depth : 0, s.f_contact});
  return metrics::motionOf(raw);
}

int aspirationsIn(Samples samples, const ScoringRules& rules) {
  return static_cast<int>(intervals(samples, [&](const TrialSample& s) {
                            return s.phase == haptics::NeedlePhase::inserted &&
                                   s.plunger >= rules.plunger_drawn;
                          }).size());
}

int backWallsIn(Samples samples) {
  int count = 0;
  for (const TrialSample& s : samples)
    count += (s.events & haptics::kWallPunctured) && s.wall == Organ::vein && s.wall_leaving;
  return count;
}

double bonePeak(Samples samples) {
  double peak = 0;
  for (const TrialSample& s : samples) peak = std::max(peak, s.bone_force);
  return peak;
}

double overForce(Samples samples, const ScoringRules& rules) {
  return heldTime(intervals(samples, [&](const TrialSample& s) {
    return isBone(s.bone) && s.bone_force > rules.clavicle_guide_N;
  }));
}

/// Mean speed of the tip before the last time it came into the vein.
double speedAtVein(Samples samples) {
  const std::vector<Interval> visits = intervals(samples, inVein);
  if (visits.empty()) return kDoesNotApply;
  const std::size_t at = visits.back().first;
  std::size_t from = at;
  while (from > 0 && samples[at].t_s - samples[from].t_s < kBeforeVein_s) --from;
  const double seconds = samples[at].t_s - samples[from].t_s;
  return seconds > 0 ? (samples[at].tip_A - samples[from].tip_A).norm() / seconds : kDoesNotApply;
}

/// Of the bevel's opening from up, about the needle; up is the front of the patient who lies there.
double bevelOff(const TrialReview& r, const anatomy::LandmarkFrame& frame) {
  if (!r.pass || !r.pass->advanced || r.pass->start_of_phase_2.bevel_A.isZero())
    return kDoesNotApply;
  const TrialSample& s = r.pass->start_of_phase_2;
  const Vec3 up_A = frame.vectorToA(-Vec3::UnitY()),
             across_A = up_A - up_A.dot(s.axis_A) * s.axis_A;
  return angleBetween(s.bevel_A, across_A);
}

/// The tip's way from the turn to the end of the scored pass.
metrics::Curve advanceOf(const TrialReview& r) {
  metrics::Curve curve;
  if (!r.pass || !r.pass->advanced) return curve;
  for (std::size_t i = r.pass->phase_2; i <= r.pass->last && i < r.samples.size(); ++i)
    curve.push_back(r.samples[i].tip_A);
  return curve;
}

/// The taught line from beside the advance's start, which is noticed some millimetres after the
/// turn, to its end.
metrics::Curve taughtBeside(const metrics::Curve& advance, const Vec3& from, const Vec3& to) {
  if (advance.empty()) return {from, to};
  const double along = (advance.front() - from).dot(to - from) / (to - from).squaredNorm();
  return {from + std::clamp(along, 0.0, 1.0) * (to - from), to};
}

double orNone(double distance_mm) {
  return std::isfinite(distance_mm) ? distance_mm : kDoesNotApply;
}

}  // namespace

std::vector<MetricValue> motionMetrics(Samples samples, const ScoringRules& rules) {
  const metrics::Motion m = motionIn(samples);
  return {{"path_length_mm", 1e3 * metrics::pathLength(m)},
          {"path_inefficiency_pct", 100 * metrics::pathInefficiency(m)},
          {"mean_speed_mm_s", 1e3 * metrics::meanSpeed(m)},
          {"bounding_box_mm3", 1e9 * metrics::boundingBoxVolume(m)},
          {"translational_actions", static_cast<double>(metrics::translationalActions(m))},
          {"rotational_actions", static_cast<double>(metrics::rotationalActions(m))},
          {"rotation_total_deg", kDegrees * metrics::rotationTotal(m)},
          {"smoothness_sparc", metrics::spectralArcLength(m)},
          {"integrated_jerk", metrics::integratedJerk(m)},
          {"peak_force_N", metrics::peakForce(m)},
          {"mean_force_N", metrics::meanForce(m)},
          {"force_jerk_N_s", metrics::forceJerk(m)},
          {"aspirations", static_cast<double>(aspirationsIn(samples, rules))},
          {"back_wall_punctures", static_cast<double>(backWallsIn(samples))},
          {"tissue_time_s", metrics::tissueTime(m)},
          {"tissue_path_mm", 1e3 * metrics::tissuePath(m)},
          {"tissue_damage_mm2", 1e6 * metrics::tissueDamage(m)},
          {"bone_force_peak_N", bonePeak(samples)},
          {"over_force_s", overForce(samples, rules)},
          {"speed_at_vein_mm_s", 1e3 * speedAtVein(samples)}};
}

std::vector<MetricValue> goalMetrics(const TrialAssessment& a, Samples samples,
                                     const ScoringRules& rules) {
  std::vector<MetricValue> all{{"success", a.values.success ? 1.0 : 0.0},
                               {"time_s", a.values.time_ms > 0 ? 1e-3 * a.values.time_ms
                                          : samples.empty()    ? 0
                                                               : samples.back().t_s}};
  for (MetricValue& m : motionMetrics(samples, rules)) all.push_back(std::move(m));
  return all;
}

std::vector<MetricValue> needleMetrics(const TrialReview& r, const TrialAssessment& a,
                                       const anatomy::LandmarkFrame& frame,
                                       const calibration::TaughtPath& path,
                                       const ScoringRules& rules) {
  const ParacentesisValues& v = r.values;
  const int passes = a.skin_punctures + a.redirections;
  const metrics::Curve advance = advanceOf(r),
                       taught = taughtBeside(advance, frame.pointToA(path.line_from_L),
                                             frame.pointToA(path.line_to_L));
  std::vector<MetricValue> all{
      {"success", v.success ? 1.0 : 0.0},
      {"time_s", 1e-3 * v.time_ms},
      {"total", a.total},
      {"col_lung", v.col_lung},
      {"col_rib", v.col_rib},
      {"col_artery", v.col_art},
      {"col_vein", v.col_vein},
      {"phase_1_mm", v.phase_1},
      {"phase_2", v.phase_2},
      {"econ_mean_mm", v.econ_mean},
      {"econ_var_mm2", v.econ_var},
      {"skin_punctures", static_cast<double>(a.skin_punctures)},
      {"redirections", static_cast<double>(a.redirections)},
      {"needle_passes", static_cast<double>(passes)},
      {"first_pass_success", v.success && passes == 1 ? 1.0 : 0.0},
      {"closest_pleura_mm", orNone(a.closest_pleura_mm)},
      {"closest_pleura_at_s",
       std::isfinite(a.closest_pleura_mm) ? a.closest_pleura_s : kDoesNotApply},
      {"closest_artery_mm", orNone(a.closest_artery_mm)},
      {"closest_artery_at_s",
       std::isfinite(a.closest_artery_mm) ? a.closest_artery_s : kDoesNotApply},
      {"frechet_mm", 1e3 * metrics::frechet(advance, taught)},
      {"hausdorff_mm", 1e3 * metrics::hausdorff(advance, taught)},
      {"warped_mm", 1e3 * metrics::timeWarped(advance, taught)}};
  all.push_back({"bevel_off_deg", kDegrees * bevelOff(r, frame)});
  if (rules.told_within_s > 0)
    all.push_back({"aspirate_told", !r.asked                                   ? kDoesNotApply
                                    : a.outcome == training::Outcome::mistaken ? 0.0
                                                                               : 1.0});
  for (MetricValue& m : techniqueMetrics(r, a.errors, frame, path, rules))
    all.push_back(std::move(m));
  for (MetricValue& m : motionMetrics(r.samples, rules)) all.push_back(std::move(m));
  return all;
}

}  // namespace palpa::assess
