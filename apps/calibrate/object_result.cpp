#include <algorithm>
#include <cmath>

#include "anatomy/base/counted.h"
#include "apps/calibrate/learnt_object.h"

namespace palpa::calibrate {
namespace {

using calibration::MappedArea;
using calibration::MapValue;
using calibration::ObjectMap;
using Eigen::Vector2d;

constexpr int kObjectGoodFor_days = 90;
constexpr std::size_t kJudgedEvery = 8;  // touch
constexpr double kOffAtOthers_percent = 10;
constexpr double kUnknown_percent = 10;  // of the area
constexpr double kMostSd = 0.05;         // of ln: 10 % to either side at 95 %
constexpr double kMostShared = 0.02;     // of ln, by what all touches have in common

/// Every eighth touch to judge by, the others to learn from.
struct Parted {
  std::vector<FeltSamples> learnt, judged;
};
Parted parted(const std::vector<FeltSamples>& touches) {
  Parted both;
  for (std::size_t i = 0; i < touches.size(); ++i)
    (i % kJudgedEvery == kJudgedEvery / 2 ? both.judged : both.learnt).push_back(touches[i]);
  return both;
}

/// Root mean square, in percent, of what touches say that the map has not seen less what it says,
/// beyond what one touch is uncertain by.
double offAtOthers(const std::vector<FeltSamples>& touches) {
  const Parted both = parted(touches);
  const LearntObject from = learnObject(both.learnt), all = learnObject(touches);
  double squares = 0;
  int count = 0;
  for (const calibration::TouchedPlace& touch : all.stiffness.touches()) {
    const auto& seen = from.stiffness.touches();
    const bool known = std::any_of(seen.begin(), seen.end(), [&](const auto& other) {
      return (other.at - touch.at).norm() < 1e-9;
    });
    if (known) continue;
    squares +=
        std::pow(touch.ln - std::log(from.stiffness.at(touch.at).value), 2) - touch.sd * touch.sd;
    ++count;
  }
  return count > 0 ? 100 * std::sqrt(std::max(squares / count, 0.0)) : 100;
}

DrawnMap drawn(const std::string& title, const std::string& unit, const ObjectMap& map,
               MappedArea area, double scale) {
  area.step = 5e-3;
  DrawnMap all{title, unit, 0, 0, 1e3 * area.low, 1e3 * area.high, {}, {}, {}};
  const Vector2d size = area.high - area.low;
  all.columns = 1 + static_cast<int>(std::lround(size.x() / area.step));
  for (const Vector2d& p : placesOf(area)) {
    const MapValue v = map.at(p);
    all.values.push_back(scale * v.value);
    all.unsure.push_back(v.sd > kMostSd);
  }
  all.rows = static_cast<int>(all.values.size()) / all.columns;
  for (const calibration::TouchedPlace& touch : map.touches())
    all.touches.emplace_back(1e3 * touch.at);
  return all;
}

void addMap(station::CalibrationFile& file, const std::string& name, const ObjectMap& map,
            const MappedArea& area) {
  std::vector<double> values, sds;
  for (const Vector2d& p : placesOf(area)) {
    const MapValue v = map.at(p);
    values.push_back(v.value);
    sds.push_back(v.sd);
  }
  file.parameters.push_back({name, values});
  file.parameters.push_back({name.substr(0, name.find('_')) + "_sd_of_ln", sds});
}

std::string range(const DrawnMap& map) {
  const auto [least, most] = std::minmax_element(map.values.begin(), map.values.end());
  return quantity(*least, map.unit) + " to " + quantity(*most, map.unit);
}

}  // namespace

Result objectResult(const ObjectTouches& samples, const MappedArea& area, const Origin& origin) {
  const LearntObject found = learnObject(samples.touches);
  const calibration::MapVerdict verdict = judge(found.stiffness, area);
  Result r;
  r.title = "The object, all over";
  r.file = begun(origin, station::CalibrationKind::object, kObjectGoodFor_days);
  r.file.parameters = {
      {"depth_m", {kLearntDepth}},
      {"low_m", {area.low.x(), area.low.y()}},
      {"high_m", {area.high.x(), area.high.y()}},
      {"step_m", {area.step}},
      {"relaxation_time_s",
       {calibration::Relaxation::kTimes.begin(), calibration::Relaxation::kTimes.end()}},
      {"relaxation_share",
       {found.pressed.relaxation.share.begin(), found.pressed.relaxation.share.end()}}};
  addMap(r.file, "stiffness_N_per_m", found.stiffness, area);
  addMap(r.file, "friction", found.friction, area);
  r.file.covariance.resize(0, 0);
  r.file.residuals = {"1", 0, {}, {}};
  r.file.checks = {{"of the top, where its stiffness is not known within 10 %",
                    100 * (1 - verdict.known), kUnknown_percent, "%"},
                   {"stiffness at touches not used, beyond their own uncertainty",
                    offAtOthers(samples.touches), kOffAtOthers_percent, "%"}};
  r.file.data.samples = found.used + found.left_out;
  r.file.data.used = found.used;
  r.file.verdict = verdictOf(r.file.checks);
  r.maps = {drawn("Stiffness, pressed 3 mm deep", "N/mm", found.stiffness, area, 1e-3),
            drawn("Friction", "", found.friction, area, 1)};
  r.sentences = {counted(found.used, "place") + " touched in " + quantity(samples.seconds, "s") +
                     ": the stiffness is " + range(r.maps[0]) + ", known within 10 % on " +
                     quantity(100 * verdict.known, "%") + " of the top.",
                 "Friction is " + range(r.maps[1]) + " times what presses."};
  if (!verdict.sure && !verdict.next.empty())
    r.advice.push_back("It is known least at " + quantity(1e3 * verdict.next.front().x(), "mm") +
                       " across, " + quantity(1e3 * verdict.next.front().y(), "mm") +
                       " along from the middle: touch it there.");
  if (found.pressed.shared_sd > kMostShared)
    r.advice.push_back("Hold a few touches for 3 s: it is not known what it loses slowly.");
  r.advice.push_back("Redo it when the object was moved on its plate, or after some months.");
  return r;
}

}  // namespace palpa::calibrate
