#include <algorithm>

#include "apps/assess/needle/wording.h"
#include "apps/training/trial_words.h"

namespace palpa::assess {

using training::Outcome;

namespace {

void addSpans(const std::vector<Interval>& stretches, const std::string& label, SpanKind kind,
              std::vector<Span>* spans) {
  for (const Interval& s : stretches) spans->push_back({label, kind, s.from_s, s.to_s});
}

void addPhases(const TrialReview& r, std::vector<Span>* spans) {
  const std::vector<ProcedurePhase>& phases = r.history.phases;
  for (std::size_t from = 0, i = 1; i <= phases.size(); ++i) {
    if (i < phases.size() && phases[i] == phases[from]) continue;
    const double to_s = i < phases.size() ? r.samples[i].t_s : r.end_s;
    spans->push_back({clinicalName(phases[from]), SpanKind::phase, r.samples[from].t_s, to_s});
    from = i;
  }
}

}  // namespace

std::vector<Span> timelineSpans(const TrialReview& r, const ScoringRules& rules) {
  std::vector<Span> spans;
  addPhases(r, &spans);
  addSpans(r.vein_lumen, "in the vein", SpanKind::good, &spans);
  addSpans(intervals(r.samples,
                     [&](const TrialSample& s) {
                       return touchesClavicle(s) && !strikesClavicle(s, rules);
                     }),
           "clavicle guides", SpanKind::guide, &spans);
  addSpans(r.clavicle_struck, "clavicle above " + newtons(rules.clavicle_guide_N), SpanKind::bad,
           &spans);
  for (const Organ bone : {Organ::rib, Organ::cartilage, Organ::sternum, Organ::scapula})
    addSpans(intervals(r.samples, [bone](const TrialSample& s) { return s.bone == bone; }),
             name(bone), SpanKind::bad, &spans);
  addSpans(r.back_wall, "back wall of the vein", SpanKind::bad, &spans);
  addSpans(r.artery, "artery", SpanKind::bad, &spans);
  addSpans(r.lung_touched, "lung", SpanKind::bad, &spans);
  return spans;
}

namespace {

using Moments = std::vector<Moment>;

void addPasses(const TrialReview& r, Moments* moments) {
  for (std::size_t n = 0; n < r.history.passes.size(); ++n) {
    const Pass& pass = r.history.passes[n];
    const std::string again = n > 0 ? " again (puncture " + std::to_string(n + 1) + ")" : "";
    moments->push_back({pass.puncture.t_s, "puncture",
                        "Skin punctured" + again + ", " + millimetres(r.entry_distances[n]) +
                            " from the optimal point"});
    if (pass.reoriented)
      moments->push_back({pass.end_of_phase_1.t_s, "reorient",
                          "Phase 1 ends at a depth of " + millimetres(pass.end_of_phase_1.depth) +
                              ": the needle is turned"});
    if (pass.advanced)
      moments->push_back(
          {pass.start_of_phase_2.t_s, "advance",
           std::string("Phase 2: the needle is advanced") +
               (pass.reoriented ? "" : " without having been turned") +
               (&pass == r.pass ? ", " + degrees(r.direction.angle) + " from the taught direction"
                                : "")});
    if (pass.last + 1 < r.samples.size())
      moments->push_back({r.samples[pass.last + 1].t_s, "withdrawn", "Needle withdrawn"});
  }
}

void addFirstBone(Samples samples, Organ bone, const char* text, Moments* moments) {
  for (const TrialSample& s : samples)
    if (s.bone == bone) {
      moments->push_back({s.t_s, "bone", text});
      return;
    }
}

void addStarts(const std::vector<Interval>& stretches, const char* kind, const std::string& text,
               Moments* moments) {
  for (const Interval& s : stretches) moments->push_back({s.from_s, kind, text});
}

/// The first aspiration of each stay in the lumen.
void addFlashes(const TrialReview& r, const ScoringRules& rules, Moments* moments) {
  for (const Interval& stay : r.vein_lumen)
    for (std::size_t i = stay.first; i <= stay.last; ++i)
      if (aspirates(r.samples[i], rules)) {
        moments->push_back({r.samples[i].t_s, "flash", "Flash of blood in the syringe"});
        break;
      }
}

Moment ending(const TrialFacts& facts, const TrialReview& r) {
  if (r.success) return {r.end_s, "success", "Blood flows freely: vein reached"};
  if (facts.outcome == Outcome::aborted) return {r.end_s, "aborted", "Trial stopped"};
  if (facts.outcome == Outcome::time) return {r.end_s, "time", "Time is over"};
  if (facts.outcome == Outcome::passes)
    return {r.end_s, "aborted", "A pass too many: the trial ends"};
  if (facts.outcome == Outcome::mistaken)
    return {r.end_s, "aborted", "What was aspirated was not recognised: the trial ends"};
  if (facts.outcome == Outcome::voided) return {r.end_s, "void", "Trial declared void"};
  return {r.end_s, "end", "Trial ended"};
}

}  // namespace

std::vector<Moment> timelineMoments(const TrialFacts& facts, const TrialReview& r,
                                    const ScoringRules& rules) {
  Moments moments;
  addPasses(r, &moments);
  addFirstBone(r.samples, Organ::clavicle, "First contact with the clavicle", &moments);
  addFirstBone(r.samples, Organ::rib, "First contact with a rib", &moments);
  addFirstBone(r.samples, Organ::cartilage, "First contact with the cartilage of a rib", &moments);
  addFirstBone(r.samples, Organ::scapula, "First contact with the scapula", &moments);
  addFirstBone(r.samples, Organ::sternum, "First contact with the sternum", &moments);
  addStarts(r.vein_lumen, "vein", "Vein entered", &moments);
  addStarts(r.back_wall, "back_wall", "Needle at the back wall of the vein", &moments);
  addFlashes(r, rules, &moments);
  addStarts(
      intervals(r.samples, [](const TrialSample& s) { return s.tissue == Tissue::artery_lumen; }),
      "artery", "Artery entered", &moments);
  addStarts(r.lung, "lung", "Lung entered", &moments);
  std::stable_sort(moments.begin(), moments.end(),
                   [](const Moment& a, const Moment& b) { return a.t_s < b.t_s; });
  if (!r.samples.empty()) moments.push_back(ending(facts, r));
  return moments;
}

}  // namespace palpa::assess
