#include "apps/twin/feeling_hands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "anatomy/base/random.h"
#include "anatomy/geometry/pose.h"
#include "apps/twin/hand_motion.h"
#include "apps/twin/hand_senses.h"

namespace palpa::twin {
namespace {

constexpr double kFullTurn = 2 * std::numbers::pi, kThirdTurn = kFullTurn / 3;
constexpr double kDecision_s = 0.01;                // 100 Hz
constexpr std::int64_t kOverview_ns = 100'000'000;  // 10 Hz
constexpr double kLetGo_s = 1.4;      // after the episode begins on the screen the handle is free
constexpr double kDescent = 0.010;    // m/s
constexpr double kPressGain = 0.004;  // m/s more for every newton too little
constexpr double kOnFloor = 1e-6;     // m
constexpr double kHeld_N = 1.5;       // across the floor, for a moment: a valley holds the probe
constexpr double kComesOff = 0.020;   // m/s, to come loose
constexpr double kComesOff_s = 0.15;  // s
constexpr double kStay_s = 0.9;       // in a middle, before looking round
constexpr double kStroke_U = 18;      // amplitude: within the texture
constexpr double kSpiral_U = 12, kSpiralPitch_U = 4;

double wrapped(double angle, double period) { return angle - period * std::round(angle / period); }

/// Where the hand wants to be, as a hand can: no corners. Critically damped, so that the
/// acceleration is known beforehand.
struct SmoothWay {
  Vec3 p = Vec3::Zero(), v = Vec3::Zero(), a = Vec3::Zero();
  void follow(const Vec3& goal, double dt) {
    constexpr double kTau = 0.015;  // s
    a = (goal - p) / (kTau * kTau) - 2 * v / kTau;
    v += a * dt;
    p += v * dt;
  }
};

class SearchingHand final : public Hand {
 public:
  SearchingHand(const SearchingSkill& skill, const VisibleFloor& floor, const Pose& X_ET,
                std::uint64_t seed)
      : skill_(skill),
        floor_(floor),
        X_ET_(X_ET),
        judgement_(seed, "searching.judgement"),
        glance_(seed, "searching.glance"),
        tremor_(skill.tremor_rms, RandomStream(seed, "searching.tremor")),
        jolts_(skill.jolt, RandomStream(seed, "searching.jolts")) {}

  Action act(const Senses& senses, double dt) override {
    look(senses, dt);
    if (!bearings_.taken()) return {senses.X_DE, 0, 0, {}};
    if (jolts_.feel(v_F_ - way_.v, dt) && step_ == SearchStep::round)
      angles_.push_back(std::atan2(p_U_.y(), p_U_.x()));
    if (senses.now_ns >= next_ns_) {
      next_ns_ = senses.now_ns + static_cast<std::int64_t>(kDecision_s * 1e9);
      think(senses);
    }
    press(senses.now_ns, dt);
    if (senses.now_ns >= loose_ns_) move(dt);
    way_.follow(floor_.unit * goal_U_, dt);
    Action action;
    action.X_DH =
        bearings_.X_DA() * makePose(R_FT_, way_.p + lead(dt) + tremor_.next(dt)) * X_ET_.inverse();
    return action;
  }
  const HandGrip& grip() const override { return skill_.grip; }

 private:
  enum class SearchStep { rest, wait, descend, reach, round, go, stroke, middle, spiral };

  void look(const Senses& senses, double dt) {
    const Pose X_DT = senses.X_DE * X_ET_;
    const Vec3 p_D = X_DT.translation(),
               v_D = last_ ? Vec3((p_D - *last_) / dt) : Vec3(Vec3::Zero());
    last_ = p_D;
    speed_ += (v_D.norm() - speed_) * std::min(1.0, dt / 0.05);
    if (senses.seen && (senses.now_ns - last_glance_ns_ >= kOverview_ns || !bearings_.taken())) {
      last_glance_ns_ = senses.now_ns;
      Pose X_FT = floor_.X_AF.inverse() * senses.seen->X_AT;
      X_FT.translation() /= floor_.magnification;  // as it is in the hand
      if (!bearings_.taken()) {
        R_FT_ = X_FT.rotation();
        goal_U_ = X_FT.translation() / floor_.unit;
        way_.p = X_FT.translation();
      } else if (X_FT.translation().z() < kOnFloor) {
        // How far it is pressed into the floor the picture does not say.
        X_FT.translation().z() = (bearings_.X_DA().inverse() * X_DT).translation().z();
      }
      bearings_.look(X_FT, X_DT, skill_.look_sd, speed_, glance_);
    }
    if (!bearings_.taken()) return;
    p_U_ = bearings_.X_DA().inverse() * X_DT.translation() / floor_.unit;
    v_F_ = bearings_.X_DA().rotation().transpose() * v_D;
    f_F_ = bearings_.X_DA().rotation().transpose() * senses.f_fingers_D;
    pressed_N_ += (-f_F_.z() - pressed_N_) * std::min(1.0, dt / 0.03);
    across_N_ += (f_F_.head<2>().norm() - across_N_) * std::min(1.0, dt / 0.1);
  }

  /// How far the hand goes before the handle, so that the grip gives all that the handle and the
  /// hand need: k e + b de/dt = M a.
  const Vec3& lead(double dt) {
    const auto& [stiffness, damping, mass] = skill_.grip;
    lead_ =
        (damping * lead_ + (floor_.handle_mass + mass) * dt * way_.a) / (damping + stiffness * dt);
    return lead_;
  }

  void begin(const SearchStep step, double now_s) {
    step_ = step;
    since_s_ = now_s;
    travelled_ = 0;
  }

  /// On the floor the hand keeps its pressure, whatever lies under it; where it is held it lets go.
  void press(std::int64_t now_ns, double dt) {
    if (step_ == SearchStep::rest || step_ == SearchStep::wait) return;
    double rate = kPressGain * (pressed_N_ - (light() ? skill_.stroke_press : skill_.press));
    if (step_ == SearchStep::descend) rate = -kDescent;
    if (now_ns < loose_ns_) rate = kComesOff;
    goal_U_.z() += rate * dt / floor_.unit;
  }

  /// On the way to somewhere else, and pulled back: a moment off the floor.
  void comeLoose(std::int64_t now_ns) {
    const bool on_the_way = light() || step_ == SearchStep::reach || step_ == SearchStep::round;
    if (!on_the_way || across_N_ < kHeld_N) return;
    across_N_ = 0;
    loose_ns_ = now_ns + static_cast<std::int64_t>(1e9 * kComesOff_s);
  }

  bool light() const { return step_ == SearchStep::go || step_ == SearchStep::stroke; }

  Vec3 onCircle(double angle) const {
    return {floor_.circle * std::cos(angle), floor_.circle * std::sin(angle), 0};
  }
  double angleOf(int element) const { return orientation_ + kThirdTurn * element; }

  /// Straight on at a speed (m/s) until there; across the floor only.
  bool toward(const Vec3& there_U, double speed, double dt) {
    const Eigen::Vector2d way = (there_U - goal_U_).head<2>();
    const double step = speed * dt / floor_.unit, left = way.norm();
    goal_U_.head<2>() += left > step ? Eigen::Vector2d(way * (step / left)) : way;
    return left <= step;
  }

  void move(double dt) {
    switch (step_) {
      case SearchStep::rest:
      case SearchStep::descend:
        return;
      case SearchStep::wait:
        goal_U_ += (Vec3(0, 0, floor_.start_height) - goal_U_) * std::min(1.0, dt / 0.2);
        return;
      case SearchStep::reach:
        arrived_ = toward(onCircle(orientation_), skill_.scan_speed, dt);
        return;
      case SearchStep::round: {
        travelled_ += skill_.scan_speed * dt / floor_.unit / floor_.circle;
        const Vec3 there = onCircle(orientation_ + travelled_);
        goal_U_.head<2>() = there.head<2>();
        return;
      }
      case SearchStep::go:
        arrived_ =
            toward(onCircle(angleOf(element_)) + kStroke_U * strokeWay(), skill_.scan_speed, dt);
        return;
      case SearchStep::stroke: {
        travelled_ += skill_.stroke_speed * dt / floor_.unit /
                      kStroke_U;  // of the phase; the peak speed is the stroke's
        const Vec3 there =
            onCircle(angleOf(element_)) + kStroke_U * std::cos(travelled_) * strokeWay();
        goal_U_.head<2>() = there.head<2>();
        return;
      }
      case SearchStep::middle:
        arrived_ = toward(onCircle(angleOf(element_)),
                          (p_U_ - onCircle(angleOf(element_))).head<2>().norm() > floor_.disc
                              ? skill_.scan_speed
                              : skill_.settle_speed,
                          dt);
        return;
      case SearchStep::spiral: {
        const double r = kSpiralPitch_U * travelled_ / kFullTurn;
        travelled_ += skill_.settle_speed * dt / floor_.unit / std::max(r, 1.0);
        const Vec3 there =
            onCircle(angleOf(element_)) + r * Vec3(std::cos(travelled_), std::sin(travelled_), 0);
        goal_U_.head<2>() = there.head<2>();
        arrived_ = r > kSpiral_U;
        return;
      }
    }
  }

  /// Across the circle, so that one stroke and the round before it do not feel the same bumps.
  Vec3 strokeWay() const { return {std::cos(angleOf(element_)), std::sin(angleOf(element_)), 0}; }

  void think(const Senses& senses) {
    const double now_s = 1e-9 * static_cast<double>(senses.now_ns), been_s = now_s - since_s_;
    if (!senses.seen) return;
    comeLoose(senses.now_ns);
    if (!senses.seen->running) {
      step_ = SearchStep::rest;
      return;
    }
    if (senses.seen->trial != trial_) {
      trial_ = senses.seen->trial;
      return begin(SearchStep::wait, now_s);
    }
    switch (step_) {
      case SearchStep::rest:
        return begin(SearchStep::descend, now_s);  // after a pause
      case SearchStep::wait:
        if (been_s > kLetGo_s) begin(SearchStep::descend, now_s);
        return;
      case SearchStep::descend:
        if (pressed_N_ < 0.5 * skill_.press) return;
        return startRounds(now_s);
      case SearchStep::reach:
        if (arrived_) begin(SearchStep::round, now_s);
        return;
      case SearchStep::round:
        if (travelled_ >= kFullTurn * (round_ + 1)) afterRound(now_s);
        return;
      case SearchStep::go:
        if (!arrived_) return;
        jolts_.beginStroke();
        return begin(SearchStep::stroke, now_s);
      case SearchStep::stroke:
        if (been_s >= skill_.stroke_s) afterStroke(now_s);
        return;
      case SearchStep::middle:
        if (!arrived_) since_s_ = now_s;  // the stay counts from there
        if (been_s > kStay_s) begin(SearchStep::spiral, now_s);
        return;
      case SearchStep::spiral:
        if (arrived_) startRounds(now_s);  // not there: all over again
        return;
    }
  }

  void startRounds(double now_s) {
    angles_.clear();
    round_ = 0;
    orientation_ = judgement_.uniform(0, kFullTurn);
    begin(SearchStep::reach, now_s);
  }

  /// Round once more while too little was noticed.
  void afterRound(double now_s) {
    ++round_;
    if (round_ < 2 ||
        (static_cast<int>(angles_.size()) < skill_.jolts * round_ && round_ < skill_.rounds))
      return;
    orientation_ = orientationBy(angles_, floor_.groove / floor_.circle,
                                 wrapped(judgement_.uniform(0, kThirdTurn), kThirdTurn));
    element_ = times_ = 0;
    felt_ = {};
    begin(SearchStep::go, now_s);
  }

  /// Every texture so many times, one after the other; what is remembered is the mean of what was
  /// felt.
  void afterStroke(double now_s) {
    felt_[static_cast<std::size_t>(element_)] +=
        std::log(jolts_.roughness()) + skill_.weber_roughness * judgement_.normal();
    element_ = (element_ + 1) % 3;
    if (element_ == 0) ++times_;
    if (times_ < skill_.strokes) return begin(SearchStep::go, now_s);
    element_ = static_cast<int>(std::max_element(felt_.begin(), felt_.end()) - felt_.begin());
    begin(SearchStep::middle, now_s);
  }

  const SearchingSkill skill_;
  const VisibleFloor floor_;
  const Pose X_ET_;
  RandomStream judgement_, glance_;
  Tremor tremor_;
  JoltSense jolts_;
  Bearings bearings_;
  SmoothWay way_;
  Mat3 R_FT_ = Mat3::Identity();
  std::optional<Vec3> last_;
  Vec3 v_F_ = Vec3::Zero(), p_U_ = Vec3::Zero(), goal_U_ = Vec3::Zero(), f_F_ = Vec3::Zero(),
       lead_ = Vec3::Zero();
  double speed_ = 0, pressed_N_ = 0, across_N_ = 0, since_s_ = 0, travelled_ = 0, orientation_ = 0;
  std::int64_t next_ns_ = 0, loose_ns_ = 0, last_glance_ns_ = -kOverview_ns;
  SearchStep step_ = SearchStep::rest;
  int trial_ = 0, element_ = 0, round_ = 0, times_ = 0;
  bool arrived_ = false;
  std::array<double, 3> felt_{};
  std::vector<double> angles_;
};

}  // namespace

double orientationBy(const std::vector<double>& angles, double half, double start) {
  constexpr int kSteps = 240;  // half a degree
  std::array<int, kSteps> within{};
  int most = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (const double angle : angles)
      within[static_cast<std::size_t>(i)] +=
          std::abs(wrapped(angle - kThirdTurn * i / kSteps, kThirdTurn)) <= half;
    most = std::max(most, within[static_cast<std::size_t>(i)]);
  }
  if (most == 0) return start;
  // The middle of the longest stretch of those that are as good; the circle goes on where it ends.
  double best = start;
  int longest = 0;
  for (int i = 0; i < kSteps; ++i) {
    int length = 0;
    while (length < kSteps && within[static_cast<std::size_t>((i + length) % kSteps)] == most)
      ++length;
    const double middle = kThirdTurn * std::fmod((i + 0.5 * (length - 1)) / kSteps, 1.0);
    const bool nearer =
        std::abs(wrapped(middle - start, kThirdTurn)) < std::abs(wrapped(best - start, kThirdTurn));
    if (length > longest || (length == longest && nearer)) best = middle, longest = length;
  }
  return longest < kSteps ? best : start;
}

std::unique_ptr<Hand> searchingHand(const SearchingSkill& skill, const VisibleFloor& floor,
                                    const Pose& X_ET, std::uint64_t seed) {
  return std::make_unique<SearchingHand>(skill, floor, X_ET, seed);
}

}  // namespace palpa::twin
