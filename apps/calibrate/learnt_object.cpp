#include "apps/calibrate/learnt_object.h"

#include <algorithm>
#include <cmath>

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
constexpr std::size_t kHeldOnes = 16;    // presses that relaxation is learnt from
constexpr double kLeastRatioSd = 0.02;   // of ln friction: no slide is like the next
constexpr std::size_t kFewestRatios = 6;

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

/// Of a touch's slide: what rubs against its way, by what presses.
std::optional<TouchedPlace> rubbedIn(const FeltSamples& touch) {
  const std::vector<FeltSample>& samples = touch.samples;
  const auto every = static_cast<std::size_t>(std::max(1.0, std::round(kApart_s / touch.dt)));
  const std::size_t begins = pressOf(touch).samples.size();
  std::vector<double> ratios;
  Vector2d middle = Vector2d::Zero();
  for (std::size_t i = begins + every; i < samples.size(); i += every) {
    const Vector2d way = (samples[i].p_P - samples[i - every].p_P).head<2>();
    const double speed = way.norm() / (static_cast<double>(every) * touch.dt),
                 gone = (samples[i].p_P - samples[begins].p_P).head<2>().norm();
    if (speed < kSlideSpeed || gone < kSlid || samples[i].f_P.z() < kSlidesUnder_N) continue;
    ratios.push_back(-samples[i].f_P.head<2>().dot(way.normalized()) / samples[i].f_P.z());
    middle += samples[i].p_P.head<2>();
  }
  if (ratios.size() < kFewestRatios) return std::nullopt;
  const auto n = static_cast<double>(ratios.size());
  double mean = 0, square = 0;
  for (const double r : ratios) mean += r / n;
  for (const double r : ratios) square += (r - mean) * (r - mean) / (n - 1);
  if (!(mean > 0)) return std::nullopt;
  return TouchedPlace{middle / n, std::log(mean),
                      std::hypot(std::sqrt(square / n) / mean, kLeastRatioSd)};
}

/// The ones that were held longest, in their order.
std::vector<std::vector<calibration::PressSample>> heldOnes(
    const std::vector<std::vector<calibration::PressSample>>& presses) {
  std::vector<std::size_t> order(presses.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return presses[a].size() > presses[b].size();
  });
  order.resize(std::min(order.size(), kHeldOnes));
  std::vector<std::vector<calibration::PressSample>> held;
  for (const std::size_t i : order) held.push_back(presses[i]);
  return held;
}

}  // namespace

LearntObject learnObject(const std::vector<FeltSamples>& touches) {
  std::vector<std::vector<calibration::PressSample>> presses;
  std::vector<Vector2d> places;
  std::vector<TouchedPlace> stiff, rubs;
  for (const FeltSamples& touch : touches) {
    const FeltSamples press = pressOf(touch);
    presses.push_back(pressesOf(press));
    places.push_back(placeOf(press));
    if (const std::optional<TouchedPlace> rubbed = rubbedIn(touch)) rubs.push_back(*rubbed);
  }
  if (touches.empty()) throw Error("has no touches", "the object", "Press it here and there");
  const double dt = touches.front().dt;
  const calibration::FoundRelaxation relaxation =
      calibration::identifyRelaxation(heldOnes(presses), dt);
  std::string why;
  for (std::size_t i = 0; i < presses.size(); ++i) {
    try {
      stiff.push_back(stiffnessOf(
          calibration::identifyElastic(presses[i], dt, relaxation.law, kLearntDepth), places[i]));
    } catch (const Error& e) {
      why = e.what();
    }
  }
  if (stiff.size() * 2 < presses.size())
    throw Error("most touches tell nothing, such as: " + why, "the object",
                "Press 3 to 5 mm deep, straight down, and hold for a moment");
  return {relaxation, calibration::ObjectMap(stiff, relaxation.shared_sd),
          calibration::ObjectMap(rubs), static_cast<int>(stiff.size()),
          static_cast<int>(presses.size() - stiff.size())};
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
