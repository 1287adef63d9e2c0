#include "calibration/parts/interaction_features.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "anatomy/base/units.h"

namespace palpa::calibration {
namespace {

using Steps = std::vector<ToolStep>;

// windows, in steps to either side
constexpr int kShort = 5, kNear = 10, kWide = 25, kLong = 50;
constexpr int kEndsAfter = 30;  // steps without contact
// what is less is alike [chosen]: a hand's tremor over the window, a fingertip's threshold
constexpr double kLeastMove = 2e-3, kLeastPush_N = 0.02, kLeastRate = 0.1, kLeastShake_N = 0.005,
                 kLeastBuzz_N = 0.002, kLeastTurn = 0.03, kLeastWay = 0.5e-3;
constexpr double kStill = 0.3e-3;    // m: a shorter way has no direction
constexpr double kTurnsFrom = 4e-3;  // m/s: slower motion does not turn back, it trembles
constexpr int kStride = 5;           // steps of 50 ms, by which turning back is told

constexpr std::array<InteractionFeatureName, kInteractionFeatures> kNames{
    {{"speed_mm_per_s", "net speed", 1e-3, true, 0.35},
     {"walk_speed_mm_per_s", "speed with every jerk", 1e-3, true, 0.3},
     {"straightness", "straightness of the way", 1, false, 0.15},
     {"along_tool", "motion along the tool", 1, false, 0.25},
     {"along_force", "motion along the force", 1, false, 0.25},
     {"force_N", "contact force", 1, true, 0.5},
     {"force_on_tool", "force along the tool", 1, false, 0.25},
     {"force_rate_N_per_s", "change of the force", 1, true, 0.6},
     {"contact", "contact", 1, false, 0.15},
     {"shaking_N", "shaking of the force", 1, true, 0.4},
     {"buzzing_N", "buzzing of the force", 1, true, 0.35},
     {"reversals_per_s", "turning back", 1, false, 0.7},
     {"turning_deg_per_s", "turning of the tool", kDegree, true, 0.5},
     {"plunger", "plunger", 1, false, 0.15},
     {"way_in_mm", "way in since it touched", kMm, true, 0.5},
     {"way_across_mm", "way across since it touched", kMm, true, 0.6}}};

double logAtLeast(double value, double least) { return std::log(std::max(value, least)); }

struct Window {
  std::size_t from, to;  // first and last step
  double seconds() const { return kInteractionStep_s * static_cast<double>(to - from); }
  double steps() const { return static_cast<double>(to - from + 1); }
};

Window about(std::size_t i, int half, std::size_t count) {
  const auto reach = static_cast<std::size_t>(half);
  return {i - std::min(i, reach), std::min(count - 1, i + reach)};
}

template <typename Value>
double meanOf(const Steps& steps, const Window& w, Value value) {
  double sum = 0;
  for (std::size_t i = w.from; i <= w.to; ++i) sum += value(steps[i]);
  return sum / w.steps();
}

Vec3 meanForce(const Steps& steps, const Window& w) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = w.from; i <= w.to; ++i) sum += steps[i].f_D;
  return sum / w.steps();
}

double wayWalked(const Steps& steps, const Window& w) {
  double way = 0;
  for (std::size_t i = w.from + kShort; i <= w.to; i += kShort)
    way += (steps[i].p_DT - steps[i - kShort].p_DT).norm();
  return way;
}

/// Mean speed by pairs of steps, as jerky as it is.
double walkSpeed(const Steps& steps, const Window& w) {
  double way = 0;
  for (std::size_t i = w.from + 2; i <= w.to; ++i)
    way += (steps[i].p_DT - steps[i - 2].p_DT).norm();
  return w.to < w.from + 2
             ? 0
             : way / (2 * kInteractionStep_s * static_cast<double>(w.to - w.from - 1));
}

/// Times a second that the way of 50 ms goes against the last one that was no trembling.
double reversalsOf(const Steps& steps, const Window& w) {
  constexpr double kLeast = kTurnsFrom * kStride * kInteractionStep_s;
  Vec3 before = Vec3::Zero();
  int turned = 0;
  for (std::size_t i = w.from + kStride; i <= w.to; i += kStride) {
    const Vec3 way = steps[i].p_DT - steps[i - kStride].p_DT;
    if (way.norm() < kLeast) continue;
    turned += before.dot(way) < -0.5 * before.norm() * way.norm();
    before = way;
  }
  return w.to > w.from ? turned / w.seconds() : 0;
}

double angleBetween(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Where the tool was when the contact of each step began; the step itself where it is in the air.
std::vector<std::size_t> contactBegan(const Steps& steps) {
  std::vector<std::size_t> began(steps.size());
  std::size_t first = 0;
  int without = kEndsAfter;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const bool touching = steps[i].contact > 0.5;  // less is the sensor's noise
    if (touching && without >= kEndsAfter) first = i;
    without = touching ? 0 : without + 1;
    began[i] = without < kEndsAfter ? first : i;
  }
  return began;
}

Eigen::RowVectorXd rowOf(const Steps& steps, std::size_t i, std::size_t began) {
  const std::size_t count = steps.size();
  const Window near = about(i, kNear, count), wide = about(i, kWide, count),
               brief = about(i, kShort, count);
  const ToolStep &here = steps[i], &start = steps[near.from], &end = steps[near.to];
  const double seconds = std::max(near.seconds(), kInteractionStep_s);
  const Vec3 move = end.p_DT - start.p_DT, force = meanForce(steps, near),
             since = here.p_DT - steps[began].p_DT;
  const double way = move.norm() + kStill, force_N = force.norm();
  const double net = (steps[wide.to].p_DT - steps[wide.from].p_DT).norm(),
               walked = wayWalked(steps, wide);
  Eigen::RowVectorXd row(static_cast<int>(kInteractionFeatures));
  row[kMoveSpeed] = logAtLeast(move.norm() / seconds, kLeastMove);
  row[kWalkSpeed] = logAtLeast(walkSpeed(steps, brief), kLeastMove);
  row[kStraightness] = (net + kStill) / (std::max(walked, net) + kStill);
  row[kAlongTool] = move.dot(here.axis_D) / way;
  row[kAlongForce] = move.dot(force) / (way * (force_N + kLeastPush_N));
  row[kPushed] = logAtLeast(meanForce(steps, brief).norm(), kLeastPush_N);
  row[kPushedOnTool] = force.dot(here.axis_D) / (force_N + kLeastPush_N);
  row[kForceRate] = logAtLeast(std::abs(meanForce(steps, about(near.to, 2, count)).norm() -
                                        meanForce(steps, about(near.from, 2, count)).norm()) /
                                   seconds,
                               kLeastRate);
  row[kTouching] = meanOf(steps, near, [](const ToolStep& s) { return s.contact; });
  row[kTrembling] = logAtLeast(
      std::sqrt(meanOf(steps, brief, [](const ToolStep& s) { return s.shaking * s.shaking; })),
      kLeastShake_N);
  const Window last{near.from, i};
  row[kBuzzing] = logAtLeast(
      std::sqrt(meanOf(steps, last, [](const ToolStep& s) { return s.buzzing * s.buzzing; })),
      kLeastBuzz_N);
  row[kReversals] = reversalsOf(steps, about(i, kLong, count));
  row[kTurning] = logAtLeast(angleBetween(start.axis_D, end.axis_D) / seconds, kLeastTurn);
  row[kPlunger] = meanOf(steps, near, [](const ToolStep& s) { return s.plunger; });
  const double in = std::max(0.0, since.dot(here.axis_D));
  row[kWayIn] = logAtLeast(in, kLeastWay);
  row[kWayAcross] = logAtLeast((since - since.dot(here.axis_D) * here.axis_D).norm(), kLeastWay);
  return row;
}

}  // namespace

const InteractionFeatureName& interactionFeatureName(int feature) {
  return kNames.at(static_cast<std::size_t>(feature));
}

Eigen::MatrixXd interactionFeatures(const std::vector<ToolStep>& steps) {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(steps.size()),
                       static_cast<int>(kInteractionFeatures));
  const std::vector<std::size_t> began = contactBegan(steps);
  for (std::size_t i = 0; i < steps.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) = rowOf(steps, i, began[i]);
  return rows;
}

}  // namespace palpa::calibration
