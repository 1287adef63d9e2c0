#pragma once

#include "apps/bench/contact_study.h"
#include "apps/bench/timing.h"
#include "apps/twin/phantom/phantom_file.h"
#include "haptics/modulation/touch_augmentation.h"

namespace palpa::bench {

/// Tools led over the plain phantom: what is felt there, onto which lumps are rendered. Fresh
/// motions above the lump's place and beside it.
struct PlainTouches {
  int tools = 1;
  std::vector<std::array<PhantomTick, 2>> ticks;  ///< the second of one tool is nowhere
};
/// With one tool, or with two side by side that press together, in turn, and stroke.
std::vector<PlainTouches> touchPlain(const twin::Phantom& plain, int tools, Noise noise);

/// A lump as it was identified on a phantom that has it, with one tool, to be rendered over the
/// plain phantom.
haptics::TouchAugmentation lumpOver(const twin::Phantom& lumped, const KnownPhantom& known,
                                    Noise noise);

/// A lump rendered over the plain phantom, against the phantom that has it.
struct LumpFigures {
  /// Rms of the combined force's error over rms of the combined force, over all tools that touch
  double error = 0;
  double unrendered = 0;   ///< the same with nothing rendered
  double position_mm = 0;  ///< largest error of where the lump is
  int iterations = 0;      ///< most of the solver
};
LumpFigures lumpFigures(const std::vector<PlainTouches>& plain, const twin::Phantom& lumped,
                        const haptics::TouchAugmentation& law);

/// What one tick of all of it costs with two devices on the plain phantom: sensed forces to
/// commands, another stiffness, another friction, two lumps; the readings of the stroke of two
/// fingers.
struct PairTiming {
  QueryTiming time;
  double pushed = 0;  ///< share of the commands that were some force: nothing was skipped
};
PairTiming pairTiming(const std::vector<PlainTouches>& plain,
                      const haptics::TouchAugmentation& law);

}  // namespace palpa::bench
