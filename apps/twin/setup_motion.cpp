#include "anatomy/geometry/random_vector.h"
#include "apps/twin/setup_bench.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "calibration/rotation.h"

namespace palpa::twin {
namespace {
using What = runtime::Request::What;
constexpr double kTravelSpeed = 0.15;  // m/s
constexpr double kShortestWay = 0.5;   // s
constexpr double kSettles = 0.25;      // s before "now" is said
constexpr double kPressFor = 0.4;      // s
constexpr double kWholeTurn = 2 * std::numbers::pi;

constexpr double kOverSample = 2e-3;  // m
constexpr double kSlowOnes = 0.6;     // share of presses; the others are taps

bool feels(What what) {
  return what == What::press || what == What::stroke || what == What::palpate;
}
bool inHole(What what) { return what == What::touch || what == What::pivot || what == What::spin; }

}  // namespace

SetupMotion::SetupMotion(const SetupHandTruth& hand, std::uint64_t seed)
    : hand_(hand),
      choices_(seed, "setup.hand"),
      jitter_(seed, "setup.jitter"),
      tremor_(hand.tremor, RandomStream(seed, "setup.tremor")),
      turn_tremor_(hand.turn_tremor, RandomStream(seed, "setup.turn_tremor")) {}

/// What a person does who is asked to press, or to stroke, for so long: never twice the same.
LedTip SetupMotion::wayOver(const Vec3& p_P) {
  const Vec3 place(p_P.x(), p_P.y(), 0);
  if (request_.what == What::press) {
    LedTip tip(place + kOverSample * Vec3::UnitZ());
    while (tip.duration() < request_.seconds) {
      if (choices_.uniform() < kSlowOnes)
        tip.press(place, request_.depth * choices_.uniform(0.5, 1.0), choices_.uniform(0.15, 0.8),
                  choices_.uniform(0.0, 0.3));
      else
        tip.press(place, request_.depth * choices_.uniform(0.4, 0.8), choices_.uniform(0.08, 0.14));
    }
    return tip;
  }
  if (request_.what == What::palpate) return touchOnce(place);
  const Vec3 before = place - request_.reach * Vec3::UnitX(),
             beyond = place + request_.reach * Vec3::UnitX();
  LedTip tip(before + kOverSample * Vec3::UnitZ());
  while (tip.duration() < request_.seconds) {
    const Vec3 below(0, 0, -request_.depth * choices_.uniform(0.5, 1.0));
    tip.go(before + below, 0.4);
    for (int i = 0; i < 2; ++i)
      tip.go(beyond + below, choices_.uniform(0.4, 1.2))
          .go(before + below, choices_.uniform(0.4, 1.2));
    tip.go(before + kOverSample * Vec3::UnitZ(), 0.4);
  }
  return tip;
}

/// Down, held, a third of it let go, sideways at about a stroke's speed, and off.
LedTip SetupMotion::touchOnce(const Vec3& place) {
  constexpr double kLetGo = 0.35, kLift_s = 0.2, kEase_s = 0.15;
  const double deep = request_.depth * choices_.uniform(0.75, 1.0),
               way = kWholeTurn * choices_.uniform();
  const Vec3 eased = place - (1 - kLetGo) * deep * Vec3::UnitZ(),
             beyond = eased + request_.reach * Vec3(std::cos(way), std::sin(way), 0);
  LedTip tip(place + kOverSample * Vec3::UnitZ());
  const double down = choices_.uniform(0.15, 0.5),
               hold = std::max(choices_.uniform(0.05, 0.5), request_.holds);
  tip.go(place - deep * Vec3::UnitZ(), down, hold)
      .go(eased, kEase_s)
      .go(beyond, choices_.uniform(0.3, 0.5))
      .go(beyond + (deep + kOverSample) * Vec3::UnitZ(), kLift_s);
  request_.seconds = tip.duration();
  return tip;
}

void SetupMotion::begin(const runtime::Request& request, const Pose& X_WT, const Vec3& p_W,
                        double t, const Pose& X_WP) {
  request_ = request;
  if (request.what ==
      What::show_board) {  // the other hand's work: the tool is put down where it is
    X_WT_ = X_WT;
    arrives_ = t;
    approach_ = MinJerk(X_WT, X_WT, t, 0);
    return;
  }
  const Vec3 lean = request.lean + hand_.lean * normal3(choices_);
  const double off = inHole(request.what) ? hand_.seat : hand_.aim;
  X_WT_ = makePose(calibration::rotationOf(lean) * calibration::halfTurnAboutX(),
                   p_W + off * normal3(choices_));
  if (feels(request.what)) {  // upright on the sample, as well as a person can
    X_WP_ = X_WP;
    felt_ = wayOver(X_WP.inverse() * p_W);
    X_WT_ =
        makePose(calibration::rotationOf(lean) * X_WP.rotation() * calibration::halfTurnAboutX(),
                 X_WP * felt_.at(0));
  }
  const double way = (X_WT_.translation() - X_WT.translation()).norm();
  const double takes = std::max(way / kTravelSpeed, kShortestWay);
  approach_ = MinJerk(X_WT, X_WT_, t, takes);
  arrives_ = t + takes;
  wave_phase_ = kWholeTurn * Vec3(choices_.uniform(), choices_.uniform(), choices_.uniform());
}

Pose SetupMotion::during(double t) const {
  const double u = t - arrives_;
  const double ease = std::min(u / 0.5, 1.0);  // begins gently
  Pose X = X_WT_;
  if (request_.what == What::pivot) {
    const double tilt = 0.55 * ease * (0.55 + 0.45 * std::sin(kWholeTurn * 0.11 * u)),
                 round = kWholeTurn * 0.45 * u;
    const Vec3 axis(std::cos(round), std::sin(round), 0);
    X.linear() = calibration::rotationOf(tilt * axis) * X.linear() *
                 calibration::rotationOf(0.6 * std::sin(kWholeTurn * 0.17 * u) * Vec3::UnitZ());
  } else if (request_.what == What::spin) {
    X.linear() = X.linear() * calibration::rotationOf(ease * 1.9 * std::sin(kWholeTurn * 0.2 * u) *
                                                      Vec3::UnitZ());
  } else if (feels(request_.what)) {
    X.translation() = X_WP_ * felt_.at(u - kSettles);
  } else if (request_.what == What::wave) {
    // Incommensurate sines: no lag but the right one makes two such motions alike.
    const Vec3& f = wave_phase_;
    X.translation() +=
        ease * 0.035 *
        Vec3(
            std::sin(kWholeTurn * 0.61 * u + f.x()) + 0.4 * std::sin(kWholeTurn * 1.37 * u + f.y()),
            std::sin(kWholeTurn * 0.47 * u + f.y()) + 0.3 * std::sin(kWholeTurn * 1.09 * u + f.z()),
            0.6 * std::sin(kWholeTurn * 0.83 * u + f.z()));
    X.linear() = calibration::rotationOf(
                     ease * 0.15 *
                     Vec3(std::sin(kWholeTurn * 0.31 * u), std::sin(kWholeTurn * 0.43 * u), 0)) *
                 X.linear();
  }
  return X;
}

Pose SetupMotion::step(double t, double dt) {
  const Vec3 shake = tremor_.next(dt), turn = turn_tremor_.next(dt);
  if (t < arrives_) {
    Pose X = approach_.at(t);
    X.translation() += shake;
    return X;
  }
  Pose X = during(t);
  X.translation() += inHole(request_.what) ? Vec3(hand_.jitter * normal3(jitter_)) : shake;
  // A needle in a drill guide has a little play; elsewhere the wrist trembles freely.
  X.linear() =
      X.linear() * calibration::rotationOf(request_.what == What::spin ? Vec3(0.5 * turn) : turn);
  return X;
}

bool SetupMotion::pressing(double t) const {
  if (request_.what == What::show_board) return false;
  const double since = t - arrives_ - kSettles;
  return since >= 0 && (request_.what == What::palpate ? since < request_.seconds
                                                       : request_.seconds > 0 || since < kPressFor);
}

}  // namespace palpa::twin
