#include "apps/runtime/geometry_activity.h"

namespace palpa::runtime {
namespace {
constexpr std::int64_t kSnapshotPeriod = 16'666'667;    // 60 Hz
constexpr double kLookAhead = 0.010;            // s: half a period and the latency
constexpr double kLargestLookAhead = 0.005;     // m: a fast hand is not predicted beyond this
}  // namespace

std::int64_t GeometryActivity::step(std::int64_t now_ns) {
  const ToolState* tool = bus_.haptic_to_geometry.read(now_ns);
  if (!tool) return now_ns + 1'000'000;
  Vec3 ahead = kLookAhead * unpack(tool->v_D);
  if (!ahead.allFinite()) ahead.setZero();
  if (ahead.norm() > kLargestLookAhead) ahead *= kLargestLookAhead / ahead.norm();
  Pose X_DT = unpack(tool->X_DT);
  if (!X_DT.matrix().allFinite()) return now_ns + kSnapshotPeriod;  // the old snapshot grows stale and fades
  X_DT.translation() += ahead;
  anatomy::LocalGeometryBuilder::Tool near;
  near.X_AT = X_AD_ * X_DT;
  near.punctured = tool->phase == haptics::NeedlePhase::inserted;
  near.entry_A = X_AD_ * unpack(tool->entry_D);
  const LocalGeometry geometry = builder_.build(++number_, now_ns, near, X_DA_);
  bus_.geometry_to_haptic.publish(geometry, now_ns + latency_ns_);
  bus_.geometry_to_recorder.push(geometry);
  return now_ns + kSnapshotPeriod;
}

}  // namespace palpa::runtime
