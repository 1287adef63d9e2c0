#include "apps/assess/timeline.h"
#include "apps/assess/wording.h"

namespace palpa::assess {
namespace {

void addSpans(const std::vector<Interval>& stretches, const std::string& label, const char* kind,
              std::vector<Span>* spans) {
  for (const Interval& s : stretches) spans->push_back({label, kind, s.from_s, s.to_s});
}

void addPhases(const TrialReview& r, std::vector<Span>* spans) {
  const std::vector<ProcedurePhase>& phases = r.history.phases;
  for (std::size_t from = 0, i = 1; i <= phases.size(); ++i) {
    if (i < phases.size() && phases[i] == phases[from]) continue;
    const double to_s = i < phases.size() ? r.samples[i].t_s : r.end_s;
    spans->push_back({clinicalName(phases[from]), "phase", r.samples[from].t_s, to_s});
    from = i;
  }
}

}  // namespace

std::vector<Span> timelineSpans(const TrialReview& r, const ScoringRules& rules) {
  std::vector<Span> spans;
  addPhases(r, &spans);
  addSpans(r.vein_lumen, "in the vein", "good", &spans);
  addSpans(intervals(r.samples,
                     [&](const TrialSample& s) {
                       return touchesClavicle(s) && !strikesClavicle(s, rules);
                     }),
           "clavicle guides", "guide", &spans);
  addSpans(r.clavicle_struck, "clavicle above " + newtons(rules.clavicle_guide_N), "bad", &spans);
  for (const Organ bone : {Organ::rib, Organ::cartilage, Organ::sternum, Organ::scapula})
    addSpans(intervals(r.samples, [bone](const TrialSample& s) { return s.bone == bone; }),
             name(bone), "bad", &spans);
  addSpans(r.back_wall, "back wall of the vein", "bad", &spans);
  addSpans(r.artery, "artery", "bad", &spans);
  addSpans(r.lung_touched, "lung", "bad", &spans);
  return spans;
}

}  // namespace palpa::assess
