#include <cmath>

#include "apps/assess/needle/wording.h"

namespace palpa::assess {
namespace {

constexpr double kSayAngle = 0.5 * M_PI / 180;  // smaller parts of a deviation are not named
constexpr double kNotTurned = 45 * M_PI / 180;  // beyond this "too steep" is no longer the point

/// " (experts vary by 3.1 mm)"; empty where the path does not say it.
std::string expertsVary(double acceptable) {
  return acceptable > 0 ? " (experts vary by " + millimetres(acceptable) + ")" : "";
}

std::string depthWords(const TrialReview& r, const calibration::TaughtPath& path) {
  const double depth = path.depth + r.entry.depth_error;
  const double off = r.entry.depth_error;
  const std::string done = r.pass->reoriented ? "; turned at a depth of " + millimetres(depth)
                                              : "; not turned before " + millimetres(depth);
  if (std::abs(off) < 0.0005) return done + ", as taught";
  return done + ", " + millimetres(std::abs(off)) + (off > 0 ? " too deep" : " too shallow") +
         expertsVary(path.depth_acceptable);
}

Penalty entry(const TrialReview& r, const calibration::TaughtPath& path,
              const ScoringRules& rules) {
  Penalty p{"PHASE_1",
            "Entry point and depth",
            "",
            r.values.phase_1,
            rules.weights.phase_1,
            rules.weights.phase_1 * r.values.phase_1,
            {},
            "mm"};
  if (!r.entry.punctured) {
    p.sentence = "The skin was not punctured; judged by the last place of the tip" +
                 offsetWords(r.entry.offset_L) + " and the whole depth.";
    return p;
  }
  p.sentence = "Entry " + millimetres(r.entry.offset_L.norm()) + " from the optimal point" +
               offsetWords(r.entry.offset_L) + expertsVary(path.entry_acceptable) +
               depthWords(r, path) + ".";
  p.moments_s = {r.pass->puncture.t_s};
  return p;
}

std::string deviationWords(const DirectionError& d) {
  std::vector<std::string> parts;
  if (d.angle > kNotTurned) return "was " + degrees(d.angle) + " away from the taught direction";
  if (std::abs(d.steeper) > kSayAngle)
    parts.push_back(degrees(std::abs(d.steeper)) + (d.steeper > 0 ? " too steep" : " too flat"));
  if (std::abs(d.more_cephalad) > kSayAngle)
    parts.push_back(degrees(std::abs(d.more_cephalad)) +
                    (d.more_cephalad > 0 ? " too cephalad" : " too caudal"));
  return parts.empty() ? "kept the taught direction" : "was " + list(parts);
}

Penalty direction(const TrialReview& r, const calibration::TaughtPath& path,
                  const ScoringRules& rules) {
  const double weight = rules.weights.phase2Weight(r.values.phase_2);
  Penalty p{"PHASE_2", "Direction of the needle", "", r.values.phase_2,
            weight,    weight * r.values.phase_2, {}};
  const bool within = r.values.phase_2 < 1000;
  const std::string margin = std::string(within ? ": no farther" : ": farther") +
                             " than experts vary (" + degrees(path.direction_acceptable) + ").";
  switch (r.direction.judged) {
    case DirectionError::Judged::never:
      p.sentence = "The needle was never inserted, so it had no direction to judge.";
      break;
    case DirectionError::Judged::at_last_insertion:
      p.sentence = "Phase 2 was not reached; when last inserted the needle " +
                   deviationWords(r.direction) + margin;
      p.moments_s = {r.samples[r.pass->last].t_s};
      break;
    case DirectionError::Judged::at_phase_2:
      p.sentence = std::string(r.pass->reoriented ? "At the start of phase 2"
                                                  : "Advanced without turning;") +
                   " the needle " + deviationWords(r.direction) + margin;
      p.moments_s = {r.pass->start_of_phase_2.t_s};
  }
  return p;
}

bool hasEconomy(const TrialReview& r) { return r.pass && r.pass->advanced; }

Penalty economyMean(const TrialReview& r, const calibration::TaughtPath& path,
                    const ScoringRules& rules) {
  Penalty p{"ECON_MEAN",
            "Distance from the taught line",
            "Phase 2 was not reached.",
            r.values.econ_mean,
            rules.weights.econ_mean,
            rules.weights.econ_mean * r.values.econ_mean,
            {},
            "mm"};
  if (!hasEconomy(r)) return p;
  if (r.economy.largest_mm < 1) {
    p.sentence = "In phase 2 tip and shaft kept to the taught line within a millimetre.";
    return p;
  }
  p.sentence = "In phase 2 tip and shaft were " + millimetres(r.economy.mean_mm / 1000) +
               " from the taught line on average" + expertsVary(path.line_acceptable) +
               ", at most " + millimetres(r.economy.largest_mm / 1000) + " at " +
               seconds(r.economy.largest_s) + ".";
  p.moments_s = {r.economy.largest_s};
  return p;
}

/// Tremor of a free hand moves a tip by 0.05 to 0.2 mm; a needle that bends to the side is seen
/// from about 2 mm on [chosen].
constexpr double kSteady = 0.0005, kLedSideways = 0.002;  // m

Penalty economyVariance(const TrialReview& r, const ScoringRules& rules) {
  Penalty p{"ECON_VAR",
            "Steadiness",
            "Phase 2 was not reached.",
            r.values.econ_var,
            rules.weights.econ_var,
            rules.weights.econ_var * r.values.econ_var,
            {},
            "mm²"};
  if (!hasEconomy(r)) return p;
  const double sd = std::sqrt(r.values.econ_var) / 1000;
  const std::string varied = "That distance varied by " + millimetres(sd) + " (standard deviation)";
  p.sentence = sd < kSteady        ? "The needle was led steadily along one line."
               : sd < kLedSideways ? varied + ": not quite steadily along one line."
                                   : varied + ": the needle was led sideways.";
  return p;
}

Penalty time(const TrialReview& r, const ScoringRules& rules) {
  const std::string took = seconds(r.time_s());
  return {"TIME",
          "Time",
          r.success ? "Blood aspirated after " + took + "."
                    : "Ended after " + took + " without success.",
          r.values.time_ms,
          rules.weights.time,
          rules.weights.time * r.values.time_ms,
          {},
          "ms"};
}

}  // namespace

std::vector<Penalty> explainPath(const TrialReview& r, const calibration::TaughtPath& path,
                                 const ScoringRules& rules) {
  return {entry(r, path, rules), direction(r, path, rules), economyMean(r, path, rules),
          economyVariance(r, rules), time(r, rules)};
}

std::vector<Penalty> explain(const TrialReview& r, const calibration::TaughtPath& path,
                             const ScoringRules& rules) {
  std::vector<Penalty> lines = explainCollisions(r, rules);
  for (Penalty& p : explainPath(r, path, rules)) lines.push_back(std::move(p));
  return lines;
}

}  // namespace palpa::assess
