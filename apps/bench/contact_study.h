#pragma once

#include <array>
#include <vector>

#include "apps/bench/phantom_recording.h"
#include "apps/bench/timing.h"
#include "apps/twin/phantom/phantom_file.h"
#include "calibration/contact_laws.h"
#include "haptics/materials/force_laws.h"
#include "haptics/modulation/modulation.h"
#include "haptics/modulation/touch_augmentation.h"

namespace palpa::bench {

/// What is known of a phantom after its identification: from presses and taps on one place, and
/// strokes.
struct KnownPhantom {
  calibration::SoftContact contact;
  calibration::SurfaceFriction friction;
};
KnownPhantom identifyPhantom(const twin::PhantomTwin& phantom, Noise noise);

/// The single-contact law with what is known; it leaves the object as it is.
haptics::StiffnessModulation feelingOf(const KnownPhantom& known, double least_contact);

/// Fresh motions over the phantom, none of them seen by the identification.
struct TouchRun {
  const char* motion;  ///< pressing, tapping, stroking
  std::vector<PhantomTick> ticks;
};
std::vector<TouchRun> freshTouches(const twin::PhantomTwin& phantom, Noise noise);

/// Root mean square of a difference over that of what it is compared with.
class RelativeRms {
 public:
  void add(const Vec3& off, const Vec3& of) {
    off2_ += off.squaredNorm();
    of2_ += of.squaredNorm();
  }
  double value() const;

 private:
  double off2_ = 0, of2_ = 0;
};

/// Models against the phantom's own forces, at its own depths and speeds, on fresh motions.
double contactForceError(const KnownPhantom& known, const std::vector<TouchRun>& runs);
double frictionForceError(const KnownPhantom& known, const std::vector<TouchRun>& runs);

/// Largest error of k, b, m, relative, on data of the very law, without noise.
double lawError();

/// The hand's force against s times the true stiffness, f_true(x)/x, with true normal, depth and
/// friction.
struct StiffnessFigures {
  double error = 0;      ///< rms over rms
  double largest_N = 0;  ///< of the device's force, and of what it may be: 2 % of the reaction
  double largest_share = 0;
};
StiffnessFigures stiffnessFigures(const KnownPhantom& known, const TouchRun& run, double factor);

/// The hand's force where another surface's friction is to be felt, against a simulated phantom
/// that has it.
double frictionModulationError(const KnownPhantom& known, const twin::PhantomTable& phantom,
                               const std::vector<TouchRun>& runs);

/// An object of simulated silicone between two tools, lifted free of its support and squeezed: its
/// weight hangs on both, and where the line between them is tilted the lower tool presses deeper.
struct SqueezeCase {
  double mass = 0;       ///< kg
  double tilt = 0;       ///< rad, of the line between the tools against the horizontal
  double factor = 1;     ///< of the true stiffness
  bool swapped = false;  ///< the tools' numbers
};
/// The hands' forces against k~ x on both, k~ = factor f_true(x)/x at the mean depth, with the true
/// weight: rms over rms.
double squeezeError(const twin::PhantomTable& side, const haptics::HuntCrossley& known,
                    const SqueezeCase& squeeze);

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
