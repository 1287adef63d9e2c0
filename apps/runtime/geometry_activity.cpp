#include "apps/runtime/geometry_activity.h"

namespace palpa::runtime {
namespace {
constexpr double kLargestLookAhead = 0.008;  // m: a fast hand is not predicted beyond this

/// The middle of the time in which the snapshot will be used, s.
double lookAhead(const GeometryActivity::Settings& s) {
  return static_cast<double>(s.latency_ns + s.blend_ns / 2 + s.period_ns / 2) * 1e-9;
}
}  // namespace

std::int64_t GeometryActivity::step(std::int64_t now_ns) {
  const ToolState* tool = bus_.haptic_to_geometry.read(now_ns);
  if (!tool) return now_ns + 1'000'000;
  Vec3 ahead = lookAhead(settings_) * unpack(tool->v_D);
  if (!ahead.allFinite()) ahead.setZero();
  if (ahead.norm() > kLargestLookAhead) ahead *= kLargestLookAhead / ahead.norm();
  ToolState near = *tool;
  near.X_DT.p = pack(Vec3(unpack(tool->X_DT.p) + ahead));
  if (!unpack(near.X_DT).matrix().allFinite())
    return now_ns + settings_.period_ns;  // the old one grows stale and fades
  bus_.geometry_to_haptic.publish(make(near, now_ns), now_ns + settings_.latency_ns);
  return now_ns + settings_.period_ns;
}

LocalGeometry GeometryActivity::make(const ToolState& tool, std::int64_t now_ns) {
  anatomy::ToolPlacement near;
  near.X_AT = X_AD_ * unpack(tool.X_DT);
  near.punctured = tool.phase == haptics::NeedlePhase::inserted;
  near.entry_A = X_AD_ * unpack(tool.entry_D);
  const LocalGeometry geometry = builder_.build(++number_, now_ns, near, X_DA_);
  bus_.geometry_to_recorder.push(geometry);
  return geometry;
}

}  // namespace palpa::runtime
