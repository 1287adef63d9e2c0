#pragma once

#include <string>
#include <vector>

#include "apps/bench/hand_study.h"
#include "haptics/squeeze_modulation.h"

namespace palpa::bench {

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
  HandFigures hands;  ///< gained: by both, beyond what the object, as heavy as it is to feel, has
                      ///< lost in height
  double dropped_mm = 0;  ///< how far the object slid down between the tools
};
GripFigures gripFigures(const twin::PhantomTable& side, const GripCase& one);

/// Harder, softer, heavier, lighter and all at once, with every device and hand.
std::vector<GripCase> gripCases(const haptics::HuntCrossley& side);

}  // namespace palpa::bench
