#include "apps/assess/needle/aspiration.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/pinned_math.h"

namespace palpa::assess {
namespace {

constexpr double kVenous = 0.25, kArterial = 0.4, kPulse = 60.0 / kHeart_per_min;  // strokes/s; s
constexpr double kGone = 0.5;                                                      // s

}  // namespace

Tissue aspiratedFrom(const TrialSample& s, const ScoringRules& rules) {
  if (s.plunger < rules.plunger_drawn) return Tissue::air;
  const bool gives = s.tissue == Tissue::vein_lumen || s.tissue == Tissue::artery_lumen ||
                     s.tissue == Tissue::lung;
  return gives ? s.tissue : Tissue::air;
}

void Syringe::add(const TrialSample& s, Tissue from, double before_s) {
  if (of_ == Tissue::lung && from == Tissue::air) of_ = Tissue::air;  // no bubble stays
  if (from != Tissue::air) of_ = from;
  const double rate = from == Tissue::vein_lumen ? kVenous
                      : from == Tissue::artery_lumen
                          ? kArterial * (1 - pinned::cos(2 * M_PI * s.t_s / kPulse))
                          : 0;
  if (rate > 0) blood_ = std::min(s.plunger, blood_ + rate * (s.t_s - before_s));
}

const char* name(Taken taken) {
  return taken == Taken::vein ? "vein" : taken == Taken::artery ? "artery" : "neither";
}

bool isRight(Taken taken, Tissue from) {
  return taken == (from == Tissue::vein_lumen     ? Taken::vein
                   : from == Tissue::artery_lumen ? Taken::artery
                                                  : Taken::neither);
}

const char* looksOf(Tissue from) {
  switch (from) {
    case Tissue::vein_lumen:
      return "dark blood that flows steadily";
    case Tissue::artery_lumen:
      return "bright blood in pulses";
    case Tissue::lung:
      return "air";
    default:
      return "nothing";
  }
}

void AspirationQuestion::add(Tissue from, double dt, const ScoringRules& rules) {
  if (asked_) {
    waited_s_ += dt;
    return;
  }
  gap_s_ = from == Tissue::air ? gap_s_ + dt : 0;
  if (from == Tissue::air) {
    held_s_ = 0;
    if (gap_s_ >= kGone) settled_ = false;
    return;
  }
  if (from != about_) held_s_ = 0, settled_ = false;
  about_ = from;
  held_s_ += dt;
  asked_ = !settled_ && held_s_ >= rules.dwell_s;
  waited_s_ = 0;
}

}  // namespace palpa::assess
