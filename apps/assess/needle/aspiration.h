#pragma once

#include <cstdint>

#include "apps/assess/needle/assess_trial.h"

namespace palpa::assess {

/// Which tissue what comes into the syringe is from: dark blood of a vein's lumen, bright blood of
/// an artery's, air of the lung. Tissue::air: nothing comes, elsewhere or with the plunger less
/// drawn than the rules ask.
Tissue aspiratedFrom(const TrialSample& s, const ScoringRules& rules);

/// Beats a minute of the patient's heart [chosen], an adult's at rest.
inline constexpr double kHeart_per_min = 72;

/// The syringe while it fills, as it is seen. Of its stroke, a second [chosen]:
///   vein    0.25, steadily
///   artery  0.4 (1 - cos(2 pi t / 0.83 s)): in pulses, 72 a minute
///   lung    nothing: bubbles
class Syringe {
 public:
  /// The time after `before_s` until this sample.
  void add(const TrialSample& s, Tissue from, double before_s);
  double blood() const { return blood_; }  ///< filled fraction
  Tissue of() const { return of_; }        ///< whose blood it is, or the lung while bubbles come

 private:
  double blood_ = 0;
  Tissue of_ = Tissue::air;
};

/// What somebody takes it for.
enum class Taken : std::uint8_t { vein, artery, neither };
const char* name(Taken taken);
/// Whether it is that: neither of air.
bool isRight(Taken taken, Tissue from);
/// "dark blood that flows steadily", "bright blood in pulses", "air": how it looks.
const char* looksOf(Tissue from);

/// When somebody must say what was aspirated: after `dwell_s` of the same without a break. Once
/// said, it is asked again only when nothing has come for half a second, or something else comes.
class AspirationQuestion {
 public:
  void add(Tissue from, double dt, const ScoringRules& rules);
  bool asked() const { return asked_; }
  Tissue about() const { return about_; }
  double waited_s() const { return waited_s_; }  ///< for the answer
  void answered() { asked_ = false, settled_ = true; }

 private:
  Tissue about_ = Tissue::air;
  double held_s_ = 0, gap_s_ = 0, waited_s_ = 0;
  bool asked_ = false, settled_ = false;
};

}  // namespace palpa::assess
