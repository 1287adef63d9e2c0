#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "apps/bench/phantom_recording.h"
#include "apps/bench/timing.h"
#include "apps/twin/device_twin.h"
#include "apps/twin/phantom/opposed_phantom.h"
#include "apps/twin/phantom/phantom_file.h"
#include "calibration/touch/contact_laws.h"
#include "haptics/materials/force_laws.h"
#include "haptics/modulation/modulation.h"
#include "haptics/modulation/pulse.h"
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

/// How late the reaction is that a loop is given, s: the shift at which it is most like the true
/// one (least squares; between ticks by a parabola).
double reactionDelay(const TouchRun& run);

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
/// weight: rms over rms. `known`: of a side, identified with the same noise.
double squeezeError(const twin::PhantomTable& side, const calibration::SoftContact& known,
                    const SqueezeCase& squeeze, Noise noise);

/// Tools led over the plain phantom: what is felt there, onto which lumps are rendered. Fresh
/// motions above the lump's place and beside it.
struct PlainTouches {
  int tools = 1;
  const char* motion = "any";
  std::vector<std::array<PhantomTick, 2>> ticks;  ///< the second of one tool is nowhere
  bool opposed = false;                           ///< the second presses from below
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
/// The same by whatever says what the tools would truly feel at these places, tick after tick;
/// asked for anew for each motion. `p_T0`: where its lump rests.
using TouchJudge = std::function<std::array<twin::PhantomTouch, 2>(const std::array<Vec3, 2>&)>;
LumpFigures lumpFigures(const std::vector<PlainTouches>& plain, const Vec3& p_T0,
                        const haptics::TouchAugmentation& law,
                        const std::function<TouchJudge(const PlainTouches&)>& judges);

/// What is known of a slab in a frame after its identification: pinched between two opposite tools,
/// and stroked; and how far it gives way as a whole under one tool alone,
///     s = x_alone(f) - x_pinched(f)
struct KnownSlab {
  KnownPhantom pinched;
  calibration::SoftContact alone;
  double givesWay(double f) const;  ///< m
};
KnownSlab identifySlab(const twin::OpposedTable& plain, Noise noise);
/// Fresh motions of two opposite tools: pinching, pressing in turn, stroking while they pinch.
std::vector<PlainTouches> pinchPlain(const twin::OpposedTable& plain, Noise noise);
/// A lump as it was identified in a slab that has it: pinched right above and below, and pressed
/// and stroked by one tool alone, in a frame that moves with the slab.
haptics::TouchAugmentation lumpInSlab(const twin::OpposedPhantom& lumped, const KnownSlab& known,
                                      Noise noise);
/// What a second tool presses with as it is estimated from the first one's reaction, both places
/// and the law, as if it had no sensor, against what it truly presses with: rms over rms, over all
/// ticks in which it touches.
double estimateError(const PlainTouches& touches, const haptics::StiffnessModulation& law,
                     double tip_radius, double thickness);
LumpFigures opposedFigures(const std::vector<PlainTouches>& plain,
                           const twin::OpposedPhantom& lumped,
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
  Noise noise = Noise::low_passed;
};
HandFigures handFigures(const twin::PhantomTwin& phantom, const HandCase& one);

/// A pulse under a tool that a hand with a device presses steadily onto a simulated phantom: the
/// hand's force f, against f_s, where the same source acts on the same tool by itself, at its true
/// place and pressure, without sensor, loop and drives; f_0: without any pulse:
///     rms(f - f_s) / rms(f_s - f_0)   along the normal
struct PulseCase {
  twin::DeviceTruth truth;
  twin::HandGrip grip;
  haptics::TouchAugmentation law;
  haptics::PulseLaw pulse;
  haptics::PulsingArtery artery;  ///< beats once a second
  double beside = 0;              ///< m, of the tool from the artery's line
  /// m, how deep: lighter than the pulse is strong, it lifts the finger off and is no pulse
  double pressed = 6e-3;
  Noise noise = Noise::kalman;
};
double pulseError(const twin::PhantomTwin& phantom, PulseCase one);

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
/// identified, at its place `p_T0` in the phantom, m. `noise`: how what is felt is cleared of it.
std::vector<HandCase> handCases(const KnownPhantom& known, const haptics::TouchAugmentation& lump,
                                const Vec3& p_T0, const std::vector<twin::HandGrip>& hands,
                                Noise noise);

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
  Noise noise = Noise::low_passed;
};
struct GripFigures {
  /// Gained: by both, beyond what the object, as heavy as it is to feel, has lost in height
  HandFigures hands;
  double dropped_mm = 0;  ///< how far the object slid down between the tools
};
GripFigures gripFigures(const twin::PhantomTable& side, const GripCase& one);

/// Harder, softer, heavier, lighter and all at once, with every device and each of `hands`.
std::vector<GripCase> gripCases(const calibration::SoftContact& side,
                                const std::vector<twin::HandGrip>& hands, Noise noise);

}  // namespace palpa::bench
