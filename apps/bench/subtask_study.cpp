#include "apps/bench/search_floor.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "anatomy/base/error.h"
#include "anatomy/base/quantile.h"
#include "anatomy/base/random.h"
#include "apps/twin/device_twin.h"
#include "haptics/loop/tick.h"

namespace palpa::bench {
namespace {

constexpr double kStudyTick = 1e-3;             // s
constexpr double kSettles = 0.06;               // s, many time constants of the speed's low-pass
constexpr double kSteady = 2;                   // s
constexpr double kSlower = 0.5, kFaster = 1.5;  // of the threshold

/// Speed `from` until kSettles, then `to`, evenly accelerated; m/s, m/s^2, 0: at once.
struct SpeedRamp {
  double from = 0, to = 0, acceleration = 0;
  double rampTime() const { return acceleration > 0 ? std::abs(to - from) / acceleration : 0; }
  double timeOf(double speed) const {
    return kSettles + (acceleration > 0 ? std::abs(speed - from) / acceleration : 0);
  }
  double end() const { return kSettles + rampTime() + kSettles; }
  double way(double t) const {
    const double in = std::clamp(t - kSettles, 0.0, rampTime()),
                 after = std::max(t - kSettles - rampTime(), 0.0);
    const double gained = rampTime() > 0 ? 0.5 * (to - from) / rampTime() * in * in : 0;
    return from * (std::min(t, kSettles) + in) + gained + to * after;
  }
};

/// Where, which way and when within a tick a straight motion begins.
struct Begin {
  Vec3 p = Vec3::Zero(), way = Vec3::UnitX();
  double t = 0;  ///< s
};
Begin drawBegin(RandomStream& random, int run, double resolution) {
  const double angle =
      run % 4 == 0 ? 0.5 * std::numbers::pi * (run / 4) : random.uniform(0, 2 * std::numbers::pi);
  Begin begin;
  begin.way = Vec3(std::cos(angle), std::sin(angle), 0);
  begin.p = Vec3(resolution * random.uniform(), resolution * random.uniform(), 0);
  begin.t = kStudyTick * random.uniform();
  return begin;
}

/// The whole tick, told where the probe is by a device of some resolution.
class PartWatch {
 public:
  PartWatch(const SpeedPart& part, double resolution)
      : part_(part), state_(std::make_unique<haptics::TickState>()) {
    device_.encoder_step = resolution;
  }

  /// Whether the part is on.
  bool step(const Vec3& p_F) {
    Pose X_DE = unpack(part_.config.X_DF);
    X_DE.translation() = X_DE * p_F;
    const PackedPose shown = twin::encoderReading(device_, X_DE);
    haptics::DeviceReading reading;
    reading.p_DE = shown.p;
    reading.q_DE = shown.q;
    reading.homed = 1;
    reading.sequence = ++sequence_;
    reading.t_ns = now_ns_ += part_.config.period_ns;
    const haptics::FlightRecord record =
        haptics::tick(part_.config, *state_, reading, nullptr, {}, now_ns_);
    return record.subtasks >> part_.part & 1;
  }

 private:
  const SpeedPart& part_;
  twin::DeviceTruth device_;
  std::unique_ptr<haptics::TickState> state_;
  std::uint64_t sequence_ = 0;
  std::int64_t now_ns_ = 0;
};

/// s; from the true speed's passing `at` until the part is `then`; to the motion's end where it
/// never is.
double latencyOf(const SpeedPart& part, const SpeedRamp& ramp, const Begin& begin,
                 double resolution, bool then) {
  const double passes = ramp.timeOf(then ? part.threshold : (1 - part.hysteresis) * part.threshold);
  PartWatch watch(part, resolution);
  for (double t = begin.t; t < ramp.end(); t += kStudyTick) {
    const bool on = watch.step(begin.p + ramp.way(t) * begin.way);
    if (t >= passes && on == then) return t - passes;
  }
  return ramp.end() - passes;
}

}  // namespace

SpeedPart speedPart(const SearchFloor& floor, const std::string& name) {
  const auto& named = floor.task.augmentations;
  for (std::size_t i = 0; i < named.subtasks.size(); ++i) {
    const haptics::Condition& c = floor.config.augmentations.subtasks.each[i].conditions[0];
    if (named.subtasks[i].name == name && c.signal == haptics::Signal::floor_speed)
      return {floor.config, static_cast<int>(i), floor.config.floor.unit * c.threshold,
              c.hysteresis};
  }
  throw Error("has no part \"" + name + "\" that is recognised by speed", floor.task.id,
              "Use the task that was shipped");
}

Latency subtaskLatency(const SpeedPart& part, double acceleration, double resolution, int runs) {
  RandomStream random(1, "bench.subtask.latency");
  std::vector<double> all;
  for (int run = 0; run < runs; ++run) {
    const Begin begin = drawBegin(random, run, resolution);
    const double slow = kSlower * part.threshold, fast = kFaster * part.threshold;
    all.push_back(1e3 * latencyOf(part, {slow, fast, acceleration}, begin, resolution, true));
    all.push_back(1e3 * latencyOf(part, {fast, slow, acceleration}, begin, resolution, false));
  }
  return {quantile(all, 1), quantile(all, 0.5)};
}

double switchesPerSecond(const SpeedPart& part, double share, double resolution, int runs) {
  RandomStream random(1, "bench.subtask.switches");
  int most = 0;
  for (int run = 0; run < runs; ++run) {
    const Begin begin = drawBegin(random, run, resolution);
    PartWatch watch(part, resolution);
    bool before = false;
    int switches = 0;
    for (double t = begin.t; t < kSettles + kSteady; t += kStudyTick) {
      const bool on = watch.step(begin.p + share * part.threshold * t * begin.way);
      switches += on != before && t >= kSettles;
      before = on;
    }
    most = std::max(most, switches);
  }
  return most / kSteady;
}

}  // namespace palpa::bench
