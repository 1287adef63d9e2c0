#include "apps/live/curve.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace palpa::live {
namespace {

constexpr std::int64_t kSlot = 20'000'000;  // ns

double rounded(double value, double step) { return std::round(value / step) * step; }

}  // namespace

double feltForce(const haptics::FlightRecord& record) {
  if (record.sensed.state == haptics::SensorState::valid)
    return (unpack(record.sensed.f_D) + unpack(record.f_command_D)).norm();
  return unpack(record.f_contact_D).norm();
}

void Curve::add(const haptics::FlightRecord& record) {
  const std::int64_t slot = record.t_ns / kSlot;
  const Point point{static_cast<double>(record.t_ns) * 1e-9, feltForce(record), 1e3 * record.depth};
  if (slot != slot_) {
    if (slot_ >= 0) points_.push_back(best_);
    slot_ = slot;
    best_ = point;
  } else if (point.force_N > best_.force_N) {
    best_ = point;
  }
  trial_ = record.commands.trial;
}

std::string Curve::take() {
  if (points_.empty()) return "";
  nlohmann::json t = nlohmann::json::array(), force = t, depth = t;
  for (const Point& point : points_) {
    t.push_back(rounded(point.t_s, 1e-3));
    force.push_back(std::isfinite(point.force_N) ? rounded(point.force_N, 1e-3) : 0);
    depth.push_back(std::isfinite(point.depth_mm) ? rounded(point.depth_mm, 1e-2) : 0);
  }
  points_.clear();
  return nlohmann::json{
      {"kind", "curve"}, {"trial", trial_}, {"t_s", t}, {"force_N", force}, {"depth_mm", depth}}
      .dump();
}

}  // namespace palpa::live
