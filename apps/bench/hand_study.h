#pragma once

#include <string>
#include <vector>

#include "apps/bench/contact_study.h"
#include "apps/twin/device_twin.h"
#include "haptics/modulation/modulation.h"
#include "haptics/modulation/touch_augmentation.h"

namespace palpa::bench {

/// A hand that presses and strokes a simulated phantom with a simulated device while a modulation
/// runs in closed loop: is it calm, and who gives the energy?
struct HandFigures {
  /// Rms of the tool's speed at the ends of holds, the worst hold: where it swings, it does not die
  double still_mm_s = 0;
  double gained_mJ = 0;  ///< most that the hand has got back beyond what it had put in, at any time
  double largest_N = 0;  ///< that the modulation asks of the device
};
struct HandCase {
  std::string device, modulation;
  twin::DeviceTruth truth;
  twin::HandGrip grip;
  haptics::TouchAugmentation law;
  haptics::PlacedLumps lumps;
  bool modulated = true;
};
HandFigures handFigures(const twin::PhantomTwin& phantom, const HandCase& one);

/// The devices that are judged, and the hands at the ends of the published range: pen grips of 0.05
/// to 0.2 kg, 2 to 10 N s/m, 100 to 1000 N/m.
struct JudgedDevice {
  const char* name;
  twin::DeviceTruth truth;
};
std::vector<JudgedDevice> judgedDevices();
std::vector<twin::HandGrip> judgedHands();
/// Of these the heavy ones that damp least, which ring longest: one soft, one stiff.
std::vector<twin::HandGrip> ringingHands();

/// Every modulation of a single contact with every device and each of `hands`; `lump`: as
/// identified, at its place `p_T0` in the phantom, m.
std::vector<HandCase> handCases(const KnownPhantom& known, const haptics::TouchAugmentation& lump,
                                const Vec3& p_T0, const std::vector<twin::HandGrip>& hands);

/// Watches a hand-held thing: calm while it is held still, energy from the hand.
class HandWatch {
 public:
  void count(double given_J, double least_J, const Vec3& f_d, const Vec3& v, bool calm_now);
  HandFigures figures() const { return figures_; }

 private:
  HandFigures figures_;
  double sum2_ = 0;
  int calm_ = 0;
};

/// Two hands that hold a simulated object between two simulated devices, in closed loop: its
/// support falls away, they lift it, squeeze it harder and hold it still in between. Frame W, z up,
/// the tools along x; the object is a mass with a soft side for each tool, free to move but not to
/// turn.
struct GripCase {
  std::string device, modulation;
  twin::DeviceTruth truth;
  twin::HandGrip grip;
  haptics::SqueezeModulation law;
  bool modulated = true;
};
struct GripFigures {
  /// Gained: by both, beyond what the object, as heavy as it is to feel, has lost in height
  HandFigures hands;
  double dropped_mm = 0;  ///< how far the object slid down between the tools
};
GripFigures gripFigures(const twin::PhantomTable& side, const GripCase& one);

/// Harder, softer, heavier, lighter and all at once, with every device and each of `hands`.
std::vector<GripCase> gripCases(const haptics::HuntCrossley& side,
                                const std::vector<twin::HandGrip>& hands);

}  // namespace palpa::bench
