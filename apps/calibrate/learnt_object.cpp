#include "apps/calibrate/learnt_object.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "anatomy/base/error.h"

namespace palpa::calibrate {
namespace {

using calibration::TouchedPlace;
using Eigen::Vector2d;

constexpr double kTouches_N = 0.03;      // less is none
constexpr double kStraight = 7e-4;       // m: what went no farther sideways was pressed
constexpr double kSlid = 1.5e-3;         // m: beyond, it truly slides
constexpr double kSlideSpeed = 5e-3;     // m/s
constexpr double kSlidesUnder_N = 0.08;  // with less the ratio is noise
constexpr double kApart_s = 0.012;       // between readings that are told apart
constexpr double kLeastRatioSd = 0.02;   // of ln friction: no slide is like the next
constexpr std::size_t kFewestReadings = 6;

/// The part of a touch that is a press: from its first sample until it goes sideways.
FeltSamples pressOf(const FeltSamples& touch) {
  FeltSamples press{touch.dt, {}};
  std::optional<Vector2d> at;
  for (const FeltSample& s : touch.samples) {
    const Vector2d p = s.p_P.head<2>();
    if (!at && s.f_P.z() > kTouches_N) at = p;
    if (at && (p - *at).norm() > kStraight) break;
    press.samples.push_back(s);
  }
  return press;
}

Vector2d placeOf(const FeltSamples& press) {
  Vector2d sum = Vector2d::Zero();
  double weight = 0;
  for (const FeltSample& s : press.samples) {
    const double f = std::max(s.f_P.z(), 0.0);
    sum += f * s.p_P.head<2>();
    weight += f;
  }
  return weight > 0 ? Vector2d(sum / weight) : Vector2d(Vector2d::Zero());
}

/// A touch's slide: at each reading what rubs against its way, what presses, and its speed.
struct Slide {
  Vector2d middle = Vector2d::Zero();
  Eigen::VectorXd drag, load, speed;  ///< N, N, m/s
};

std::optional<Slide> slideIn(const FeltSamples& touch) {
  const std::vector<FeltSample>& samples = touch.samples;
  const auto every = static_cast<std::size_t>(std::max(1.0, std::round(kApart_s / touch.dt)));
  const std::size_t begins = pressOf(touch).samples.size();
  std::vector<Eigen::Vector3d> readings;
  Slide slide;
  for (std::size_t i = begins + every; i < samples.size(); i += every) {
    const Vector2d way = (samples[i].p_P - samples[i - every].p_P).head<2>();
    const double speed = way.norm() / (static_cast<double>(every) * touch.dt),
                 gone = (samples[i].p_P - samples[begins].p_P).head<2>().norm();
    if (speed < kSlideSpeed || gone < kSlid || samples[i].f_P.z() < kSlidesUnder_N) continue;
    readings.emplace_back(-samples[i].f_P.head<2>().dot(way.normalized()), samples[i].f_P.z(),
                          speed);
    slide.middle += samples[i].p_P.head<2>();
  }
  if (readings.size() < kFewestReadings) return std::nullopt;
  const auto n = static_cast<Eigen::Index>(readings.size());
  slide.middle /= static_cast<double>(n);
  const Eigen::Map<const Eigen::Matrix3Xd> all(readings.front().data(), 3, n);
  slide.drag = all.row(0);
  slide.load = all.row(1);
  slide.speed = all.row(2);
  return slide;
}

/// B of  drag = mu load + B speed,  the same in every slide, each with its own mu: least squares.
double viscousIn(const std::vector<Slide>& slides) {
  double drags = 0, speeds = 0;
  for (const Slide& slide : slides) {  // what mu cannot explain of either
    const Eigen::VectorXd speed =
        slide.speed - slide.load * (slide.load.dot(slide.speed) / slide.load.squaredNorm());
    drags += speed.dot(slide.drag);
    speeds += speed.squaredNorm();
  }
  return speeds > 0 ? std::max(drags / speeds, 0.0) : 0;
}

std::optional<TouchedPlace> rubbedIn(const Slide& slide, double viscous) {
  const Eigen::VectorXd rubs = slide.drag - viscous * slide.speed;
  const double squares = slide.load.squaredNorm(), mu = slide.load.dot(rubs) / squares;
  if (!(mu > 0)) return std::nullopt;
  const double left =
      (rubs - mu * slide.load).squaredNorm() / static_cast<double>(slide.load.size() - 1);
  return TouchedPlace{slide.middle, std::log(mu),
                      std::hypot(std::sqrt(left / squares) / mu, kLeastRatioSd)};
}

}  // namespace

LearntObject learnObject(const std::vector<FeltSamples>& touches) {
  if (touches.empty()) throw Error("has no touches", "the object", "Press it here and there");
  std::vector<calibration::Press> presses;
  std::vector<Slide> slides;
  for (const FeltSamples& touch : touches) {
    const FeltSamples press = pressOf(touch);
    presses.push_back({placeOf(press), pressesOf(press)});
    if (std::optional<Slide> slide = slideIn(touch)) slides.push_back(std::move(*slide));
  }
  const calibration::PressedThing pressed =
      calibration::identifyPresses(presses, touches.front().dt, kLearntDepth);
  std::vector<TouchedPlace> stiff, rubs;
  for (std::size_t i = 0; i < presses.size(); ++i)
    if (pressed.presses[i]) stiff.push_back(stiffnessOf(*pressed.presses[i], presses[i].at));
  if (stiff.size() * 2 < presses.size())
    throw Error("most touches tell nothing, such as: " + pressed.why, "the object",
                "Press 3 to 5 mm deep, straight down, and hold for a moment");
  for (Slide& slide : slides) slide.load.array() -= pressed.offset_N;
  const double viscous = viscousIn(slides);
  for (const Slide& slide : slides)
    if (const std::optional<TouchedPlace> rubbed = rubbedIn(slide, viscous))
      rubs.push_back(*rubbed);
  return {pressed,
          calibration::ObjectMap(stiff, pressed.shared_sd),
          calibration::ObjectMap(rubs),
          viscous,
          static_cast<int>(stiff.size()),
          static_cast<int>(presses.size() - stiff.size())};
}

station::MappedObject mappedObjectOf(const LearntObject& object,
                                     const calibration::MappedArea& area) {
  const calibration::Relaxation& relaxation = object.pressed.relaxation;
  station::MappedObject mapped;
  mapped.low = area.low;
  mapped.high = area.high;
  mapped.depth = kLearntDepth;
  mapped.relaxation_share.assign(relaxation.share.begin(), relaxation.share.end());
  mapped.relaxation_time.assign(relaxation.kTimes.begin(), relaxation.kTimes.end());
  for (const Vector2d& p : placesOf(area)) {
    const calibration::MapValue stiffness = object.stiffness.at(p);
    mapped.stiffness.push_back(stiffness.value);
    mapped.stiffness_sd.push_back(stiffness.sd);
    mapped.friction.push_back(object.friction.at(p).value);
  }
  mapped.columns = 1 + static_cast<int>(std::lround((area.high - area.low).x() / area.step));
  mapped.rows = static_cast<int>(mapped.stiffness.size()) / mapped.columns;
  return mapped;
}

ObjectTouches touchesIn(const FeltSamples& felt) {
  constexpr double kBefore_s = 0.05, kShortest_s = 0.15;
  ObjectTouches all;
  all.seconds = felt.dt * static_cast<double>(felt.samples.size());
  const auto before = static_cast<std::ptrdiff_t>(kBefore_s / felt.dt);
  const auto begin = felt.samples.begin(), end = felt.samples.end();
  const auto touches = [](const FeltSample& s) { return s.f_P.z() > kTouches_N; };
  for (auto from = std::find_if(begin, end, touches); from != end;) {
    const auto to = std::find_if_not(from, end, touches);
    if (static_cast<double>(to - from) * felt.dt > kShortest_s)
      all.touches.push_back({felt.dt, {from - std::min(before, from - begin), to}});
    from = std::find_if(to, end, touches);
  }
  return all;
}

calibration::MappedArea objectArea() {
  calibration::MappedArea area;
  area.low = Vector2d::Constant(-0.05);
  area.high = Vector2d::Constant(0.05);
  area.step = 4e-3;
  return area;
}

}  // namespace palpa::calibrate
