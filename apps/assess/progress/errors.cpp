#include "apps/assess/progress/errors.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace palpa::progress {

using training::Engine;

namespace {

constexpr std::size_t kLately = 5;

const std::map<Engine, std::vector<ErrorKind>> kKindsOfEngines{
    {Engine::needle,
     {{"col_lung", 0, false, "the pleura was touched",
       "keep the needle flat behind the clavicle and stop at the depth that was taught: the lung "
       "lies behind the vein"},
      {"col_artery", 0, false, "an artery was touched",
       "advance slowly with the plunger drawn and stop at the first blood: the artery lies "
       "behind the vein"},
      {"back_wall_punctures", 0, false, "the vein's back wall was punctured",
       "advance more slowly near the vein: in a porcine jugular 3 mm/s kept the needle in it "
       "best"},
      {"error_landmarks", 0.5, false, "the landmarks were not identified",
       "feel for the clavicle's bend and the suprasternal notch, and name both aloud, before the "
       "needle touches the skin"},
      {"error_site", 0.5, false, "the entry was at the wrong distance from the clavicle",
       "mark the entry a finger's breadth below the clavicle before the needle touches the skin"},
      {"error_left_vein", 0.5, false, "the needle left the vein",
       "rest the hand on the patient and hold the hub still as soon as blood comes"},
      {"error_periosteum", 0.5, false, "the needle was pressed through the periosteum",
       "touch the clavicle lightly, then lower the needle and pass behind it"},
      {"error_shallow", 0.5, false, "the needle was led too flat",
       "pass just behind the clavicle: too flat a needle runs in front of the vein"},
      {"error_cephalad", 0.5, false, "the needle was aimed too far toward the head",
       "aim at the suprasternal notch, a finger in it: toward the head lies the artery"},
      {"needle_passes", 3, false, "more than three needle passes",
       "after three passes stop and ask: every further pass multiplies complications"},
      {"needle_passes", 1, false, "more than one needle pass",
       "find the landmarks again before the needle goes in, rather than turning it inside"},
      {"over_force_s", 0, false, "bone was pressed too hard",
       "touch the clavicle lightly: it is the guide, not a place to push on"},
      {"col_rib", 0, false, "rib or bone was struck",
       "lower the syringe before the advance, so that the needle slides under the clavicle"},
      {"col_vein", 0, false, "the vein was touched without success",
       "draw the plunger before the vein is reached and stop when blood comes"},
      {"phase_2", 1000, false, "the direction was farther off than experts vary",
       "turn the needle fully toward the sternal end before the advance"},
      {"success", 0.5, true, "the vein was not reached",
       "repeat entry point and direction with the three fixed views before the next trial"}}},
    {Engine::palpation,
     {{"sensitivity_pct", 99.9, true, "a lump was missed",
       "feel every place lightly, then firmly, then deep"},
      {"false_alarms", 0, false, "something was marked where nothing is",
       "compare with the same place on the other side before marking"},
      {"coverage_deep_pct", 95, true, "less than 95 % was felt deep",
       "search in overlapping strips and press deep in each place"},
      {"coverage_light_pct", 95, true, "less than 95 % was felt at all",
       "search in overlapping strips from edge to edge"},
      {"too_hard_pct", 5, false, "pressed too hard for more than 5 % of the time",
       "more force than the largest sensible one finds nothing more and hurts"}}},
    {Engine::search,
     {{"chosen", 0.5, true, "no element was chosen in time",
       "visit each element once before looking closer"},
      {"success", 0.5, true, "the target was not found",
       "cross each element at the same speed and compare before staying in one"}}},
    {Engine::squeeze,
     {{"success", 0.5, true, "the answer was wrong or missing",
       "squeeze both equally deep and equally fast before answering"}}},
    {Engine::friction,
     {{"success", 0.5, true, "the answer was wrong or missing",
       "stroke each surface with the same pressure and the same speed before answering"}}},
    {Engine::pulse,
     {{"pulse_found", 0.5, true, "the pulse was not found",
       "search across the artery with light pressure, in small steps, before marking"},
      {"count_error_per_min", 3, false, "the pulse was counted wrong",
       "count for the full 30 s with steady, light pressure"},
      {"rhythm_told", 0.5, true, "the rhythm was named wrong",
       "attend to the pauses between beats, not only to their number"}}}};

assess::ParacentesisValues valuesOf(const PracticeTrial& t) {
  return {t.metric("col_lung"),     t.metric("col_rib"),
          t.metric("col_artery"),   t.metric("col_vein"),
          t.metric("phase_1_mm"),   t.metric("phase_2"),
          t.metric("econ_mean_mm"), t.metric("econ_var_mm2"),
          1e3 * t.metric("time_s"), t.succeeded()};
}

bool weighsLikeThat(const PracticeTrial& trial, const assess::ScoreWeights& weights) {
  const double stored = trial.metric("total");
  return std::abs(assess::total(valuesOf(trial), weights) - stored) <=
         1e-6 * std::max(1.0, std::abs(stored));  // false for what is no number
}

}  // namespace

const std::vector<ErrorKind>& errorKinds(std::optional<Engine> engine) {
  static const std::vector<ErrorKind> kNone;
  return engine ? kKindsOfEngines.at(*engine) : kNone;
}

Happened happenedIn(const ErrorKind& kind, std::span<const PracticeTrial> trials) {
  const std::size_t number = figureNumber(kind.metric);
  Happened happened;
  for (const PracticeTrial& trial : trials) {
    const double value = trial.figures[number];
    if (!std::isfinite(value)) continue;
    ++happened.of;
    happened.with += (kind.below ? value < kind.above : value > kind.above) ? 1 : 0;
  }
  return happened;
}

std::vector<ErrorCount> errorsIn(const PracticeView& practice) {
  std::vector<ErrorCount> counts;
  const auto late = practice.trials.last(std::min(practice.trials.size(), kLately));
  for (const ErrorKind& kind : errorKinds(practice.engine))
    if (const Happened all = happenedIn(kind, practice.trials); all.with > 0)
      counts.push_back({&kind, all, happenedIn(kind, late)});
  return counts;
}

std::vector<std::string> practiseNext(const PracticeView& practice) {
  std::vector<std::string> all;
  const auto add = [&](const ErrorKind& kind) {
    if (all.size() < 2 && std::find(all.begin(), all.end(), kind.practise) == all.end())
      all.emplace_back(kind.practise);
  };
  const std::vector<ErrorCount> errors = errorsIn(practice);
  for (const ErrorCount& error : errors)
    if (error.recurs()) add(*error.kind);
  if (!all.empty() || practice.trials.empty()) return all;
  for (const ErrorCount& error : errors)
    if (happenedIn(*error.kind, practice.trials.last(1)).with > 0) add(*error.kind);
  if (!all.empty()) return all;
  if (!practice.trials.back().succeeded())
    return {"the same again, until it succeeds several times in a row"};
  return {practice.engine == Engine::needle ? "the same on other patients and on the other side"
                                            : "the same again, with other cases"};
}

std::vector<std::string> practiseNext(Engine engine, const std::vector<JudgedTrial>& session) {
  return practiseNext({engine, practiceOf(engine, session)});
}

namespace {

/// The usual weights, as published or continuous: those that give the trial's total.
std::optional<assess::ScoreWeights> weightsOf(const PracticeTrial& trial) {
  for (const auto phase_2 : {assess::Phase2Weight::continuous, assess::Phase2Weight::steps}) {
    assess::ScoreWeights weights;
    weights.phase_2 = phase_2;
    if (weighsLikeThat(trial, weights)) return weights;
  }
  return std::nullopt;
}

}  // namespace

std::vector<Cost> costsLately(const Series& series) {
  std::vector<Cost> costs{{"col_lung"},     {"col_rib"},      {"col_artery"},
                          {"col_vein"},     {"phase_1_mm"},   {"phase_2"},
                          {"econ_mean_mm"}, {"econ_var_mm2"}, {"time_s"}};
  const std::size_t n = std::min(series.trials.size(), kLately);
  for (std::size_t i = series.trials.size() - n; i < series.trials.size(); ++i) {
    const PracticeTrial& trial = series.trials[i];
    const std::optional<assess::ScoreWeights> usual = weightsOf(trial);
    if (!usual) return {};
    const assess::ScoreWeights& w = *usual;
    const assess::ParacentesisValues v = valuesOf(trial);
    const double points[] = {
        w.lung * v.col_lung,       w.rib * v.col_rib,       w.artery * v.col_art,
        w.vein * v.col_vein,       w.phase_1 * v.phase_1,   w.phase2Weight(v.phase_2) * v.phase_2,
        w.econ_mean * v.econ_mean, w.econ_var * v.econ_var, w.time * v.time_ms};
    for (std::size_t c = 0; c < costs.size(); ++c)
      costs[c].points += points[c] / static_cast<double>(n);
  }
  std::erase_if(costs, [](const Cost& c) { return !(c.points > 0); });
  std::stable_sort(costs.begin(), costs.end(),
                   [](const Cost& a, const Cost& b) { return a.points > b.points; });
  return costs;
}

std::vector<NearestMiss> nearestMisses(const Series& series, const std::string& organ,
                                       std::size_t most) {
  std::vector<NearestMiss> misses;
  for (std::size_t i = 0; i < series.trials.size(); ++i) {
    const double distance = series.trials[i].metric("closest_" + organ + "_mm");
    if (distance > 0)
      misses.push_back({distance, series.trials[i].metric("closest_" + organ + "_at_s"), i + 1});
  }
  std::stable_sort(misses.begin(), misses.end(), [](const NearestMiss& a, const NearestMiss& b) {
    return a.distance_mm < b.distance_mm;
  });
  misses.resize(std::min(misses.size(), most));
  return misses;
}

}  // namespace palpa::progress
