#pragma once

#include <string>
#include <vector>

#include "apps/bench/contact_study.h"
#include "apps/twin/device_twin.h"
#include "haptics/friction_modulation.h"

namespace palpa::bench {

/// A hand that presses and strokes a simulated phantom with a simulated device while a modulation runs in closed loop: is it calm, and who gives the energy?
struct HandFigures {
  double still_mm_s = 0;          ///< rms of the tool's speed at the ends of holds, the worst hold: where it swings, it does not die
  double gained_mJ = 0;           ///< most that the hand has got back beyond what it had put in, at any time
  double largest_N = 0;           ///< that the modulation asks of the device
};
struct HandCase {
  std::string device, modulation;
  twin::DeviceTruth truth;
  twin::HandGrip grip;
  haptics::FrictionModulation law;   ///< of both: with the real friction as the wanted one it changes stiffness alone
  bool modulated = true;
};
HandFigures handFigures(const twin::PhantomTwin& phantom, const HandCase& one);

/// The devices and modulations that are judged, each with the hands at the ends of the published range: pen grips of 0.05 to 0.2 kg, 2 to 10 N s/m, 100 to 1000 N/m.
std::vector<HandCase> handCases(const KnownPhantom& known);

}  // namespace palpa::bench
