#include "apps/task_palpation/palpation_listener.h"

#include <cmath>

namespace palpa::task_palpation {
namespace {

constexpr std::int64_t kEvery_ns = 10'000'000;
constexpr double kLongestGap_s = 0.1;  // longer: it was paused

}  // namespace

PalpationListener::PalpationListener(const haptics::TickConfig& config)
    : X_PD_(unpack(config.X_DP).inverse()),
      X_ET_(unpack(config.X_ET)),
      radius_(config.touch.tip_radius) {}

void PalpationListener::begin(std::uint32_t trial) {
  trial_ = trial;
  last_ns_ = kept_ns_ = -1;
  seconds_ = 0;
  pressed_ = true;  // a button that is down already marks nothing
  samples_.clear();
  marks_.clear();
}

bool PalpationListener::add(const haptics::FlightRecord& record) {
  if (record.commands.trial != trial_) return false;
  if (!record.commands.armed || !record.reading.homed) {
    pressed_ = true;  // what is pressed over a pause marks nothing
    return false;
  }
  const double dt = last_ns_ < 0 ? 0 : 1e-9 * static_cast<double>(record.t_ns - last_ns_);
  last_ns_ = record.t_ns;
  if (dt > 0 && dt < kLongestGap_s) seconds_ += dt;
  const Pose X_DE = makePose(unpack(record.reading.q_DE).normalized().toRotationMatrix(),
                             unpack(record.reading.p_DE));
  const Vec3 p_P = X_PD_ * (X_DE * (X_ET_ * Vec3(0, 0, -radius_))) - radius_ * Vec3::UnitZ();
  const bool down = (record.reading.buttons & kMark) != 0;
  if (down && !pressed_ && p_P.z() < kOver) marks_.push_back({seconds_, p_P, 0, 0, 0});
  pressed_ = down;
  if (kept_ns_ >= 0 && record.t_ns - kept_ns_ < kEvery_ns) return false;
  kept_ns_ = record.t_ns;
  const Vec3 f_D = unpack(record.sensed.f_D) + unpack(record.f_command_D);
  samples_.push_back({seconds_, p_P, std::max((X_PD_.linear() * f_D).z(), 0.0)});
  return true;
}

void PalpationListener::grade(double diameter, int hardness, int mobility, std::size_t mark) {
  if (marks_.empty() || mark > marks_.size()) return;
  assess::LumpMark& graded = marks_[(mark > 0 ? mark : marks_.size()) - 1];
  if (diameter > 0) graded.diameter = diameter;
  if (hardness > 0) graded.hardness = hardness;
  if (mobility > 0) graded.mobility = mobility;
}

}  // namespace palpa::task_palpation
