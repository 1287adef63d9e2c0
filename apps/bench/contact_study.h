#pragma once

#include <vector>

#include "apps/bench/phantom_recording.h"
#include "calibration/contact_laws.h"
#include "haptics/materials/force_laws.h"
#include "haptics/modulation/modulation.h"

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

}  // namespace palpa::bench
