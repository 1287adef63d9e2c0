#include "apps/assess/needle/contacts.h"

#include <algorithm>
#include <limits>

namespace palpa::assess {

bool inLung(const TrialSample& s) { return s.tissue == Tissue::lung; }
bool touchesLung(const TrialSample& s) { return inLung(s) || s.wall == Organ::lung; }
bool touchesArtery(const TrialSample& s) {
  return s.tissue == Tissue::artery_lumen || s.wall == Organ::artery;
}
bool inVein(const TrialSample& s) { return s.tissue == Tissue::vein_lumen; }
bool touchesVein(const TrialSample& s) { return inVein(s) || s.wall == Organ::vein; }

bool touchesBackWall(const TrialSample& s) {
  const bool entering_now = (s.events & haptics::kWallPunctured) && !s.wall_leaving;
  // A tip in the lumen can only press on the far wall, whether or not the record says so.
  return s.wall == Organ::vein && (s.wall_leaving || (inVein(s) && !entering_now));
}

bool touchesRibcage(const TrialSample& s) { return isBone(s.bone) && s.bone != Organ::clavicle; }
bool touchesClavicle(const TrialSample& s) { return s.bone == Organ::clavicle; }
bool strikesClavicle(const TrialSample& s, const ScoringRules& rules) {
  return touchesClavicle(s) && s.bone_force > rules.clavicle_guide_N;
}
bool aspirates(const TrialSample& s, const ScoringRules& rules) {
  return inVein(s) && s.plunger >= rules.plunger_drawn;
}

bool entersArtery(Samples samples) {
  return std::any_of(samples.begin(), samples.end(),
                     [](const TrialSample& s) { return s.tissue == Tissue::artery_lumen; });
}

bool piercesBackWall(Samples samples) {
  return std::any_of(samples.begin(), samples.end(), [](const TrialSample& s) {
    return (s.events & haptics::kWallPunctured) && s.wall == Organ::vein && s.wall_leaving;
  });
}

std::size_t successSample(Samples samples, const ScoringRules& rules) {
  double since = -1;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!aspirates(samples[i], rules)) {
      since = -1;
      continue;
    }
    if (since < 0) since = samples[i].t_s;
    if (samples[i].t_s - since >= rules.dwell_s - 1e-9) return i;
  }
  return samples.empty() ? 0 : samples.size() - 1;
}

FinalStay finalStay(Samples samples) {
  FinalStay stay;
  for (const Interval& visit : intervals(samples, touchesVein))
    for (std::size_t i = visit.first; i <= visit.last; ++i)
      if (inVein(samples[i])) {
        stay = {true, visit};
        break;
      }
  return stay;
}

namespace {

bool strikesBone(const TrialSample& s, const ScoringRules& rules) {
  return touchesRibcage(s) || strikesClavicle(s, rules);
}

int boneContacts(Samples samples, const ScoringRules& rules) {
  int count = 0;
  for (const Interval& contact :
       intervals(samples, [&](const TrialSample& s) { return strikesBone(s, rules); }))
    count += 1 + static_cast<int>(contact.held_s + 1e-9);
  return count;
}

}  // namespace

CollisionCounts countCollisions(Samples samples, const FinalStay& stay, const ScoringRules& rules) {
  CollisionCounts counts;
  for (const std::size_t i : scoringSamples(samples, rules.sample_rate_Hz)) {
    const TrialSample& s = samples[i];
    counts.lung += touchesLung(s);
    counts.rib += strikesBone(s, rules);
    counts.artery += touchesArtery(s);
    counts.vein += touchesVein(s) && (!stay.covers(i) || touchesBackWall(s));
  }
  if (rules.bone_unit == BoneUnit::contacts) counts.rib = boneContacts(samples, rules);
  return counts;
}

ClosestApproach nearMiss(Samples samples, Organ organ, const OrganDistance& distance,
                         double rate_Hz) {
  ClosestApproach closest{std::numeric_limits<double>::infinity()};
  for (const std::size_t i : scoringSamples(samples, rate_Hz)) {
    if (samples[i].phase != haptics::NeedlePhase::inserted) continue;
    const double d = distance(organ, samples[i].tip_A);
    if (d < closest.distance) closest = {d, samples[i].t_s};
  }
  return closest;
}

}  // namespace palpa::assess
