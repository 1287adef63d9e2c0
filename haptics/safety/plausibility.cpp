#include "haptics/safety/plausibility.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace palpa::haptics {
namespace {

constexpr double kUnit = 1e-6;  // of a unit vector's squared length, and of a right angle's cosine
constexpr double kWidestPatch = 1;     // m
constexpr double kTallestTerm = 1;     // m, of any term of a patch at its rim
constexpr double kSteepestTerm = 100;  // slope of any term at the rim
constexpr double kSharpestTerm = 1e9;  // any coefficient: no overflow however small the reach
constexpr double kThickestBone = 0.2;  // m

bool near(const Packed3& p) {  // a comparison with a NaN is false
  return std::abs(p[0]) <= kFarthest && std::abs(p[1]) <= kFarthest && std::abs(p[2]) <= kFarthest;
}

bool unit(const Packed3& n) { return std::abs(unpack(n).squaredNorm() - 1) <= kUnit; }

bool plausiblePatch(const SurfacePatch& patch) {
  static constexpr int kDegree[SurfacePatch::kTerms] = {0, 1, 1, 2, 2, 2, 3, 3, 3, 3};
  if (!near(patch.p) || !unit(patch.n) || !unit(patch.x)) return false;
  if (!(std::abs(unpack(patch.n).dot(unpack(patch.x))) <= kUnit)) return false;
  if (!(patch.reach >= 0 && patch.reach <= kWidestPatch)) return false;
  const double power[] = {1, patch.reach, patch.reach * patch.reach,
                          patch.reach * patch.reach * patch.reach};
  for (int i = 0; i < SurfacePatch::kTerms; ++i) {
    const double c = std::abs(patch.c[i]);
    if (!(c <= kSharpestTerm && c * power[kDegree[i]] <= kTallestTerm)) return false;
    if (kDegree[i] > 0 && !(c * power[kDegree[i] - 1] <= kSteepestTerm)) return false;
  }
  return true;
}

bool known(Organ organ) { return static_cast<int>(organ) < kOrganCount; }
bool known(Tissue tissue) { return static_cast<int>(tissue) < kTissueCount; }

bool plausibleBone(const Capsule& bone) {
  return near(bone.a) && near(bone.b) && bone.radius >= 0 && bone.radius <= kThickestBone &&
         known(bone.organ);
}

bool plausibleBoundary(const Boundary& boundary) {
  unsigned char leaving;  // damaged bytes may hold what no bool can
  std::memcpy(&leaving, &boundary.leaving, 1);
  return near(boundary.p) && unit(boundary.n) && known(boundary.from) && known(boundary.to) &&
         known(boundary.wall) && leaving <= 1;
}

}  // namespace

bool plausible(const LocalGeometry& geometry) noexcept {
  if (geometry.number == 0 || !plausiblePatch(geometry.skin)) return false;
  if (geometry.bone_count < 0 || geometry.bone_count > LocalGeometry::kMaxBones) return false;
  if (geometry.boundary_count < 0 || geometry.boundary_count > LocalGeometry::kMaxBoundaries)
    return false;
  for (int i = 0; i < geometry.bone_count; ++i)
    if (!plausibleBone(geometry.bones[i])) return false;
  for (int i = 0; i < geometry.boundary_count; ++i)
    if (!plausibleBoundary(geometry.boundaries[i])) return false;
  return true;
}

bool possible(const DeviceReading& reading) noexcept {
  const double size = unpack(reading.q_DE).norm();
  const Packed3& p = reading.p_DE;  // a comparison with a NaN is false
  return std::abs(p[0]) <= kFarthest && std::abs(p[1]) <= kFarthest &&
         std::abs(p[2]) <= kFarthest && size > 0.5 && size < 2;
}

bool steady(const SafetyLimits& limits, std::int64_t period_ns, const NeedlePose& pose,
            std::uint64_t sequence, double elapsed_ns, ReadingState& state) noexcept {
  const double elapsed = std::max(elapsed_ns, 0.0);
  state.since_ns = std::min(state.since_ns + elapsed, static_cast<double>(limits.silent_ns));
  const double moved =
      std::max((pose.p_DE - unpack(state.p_DE)).norm(), (pose.p_DT - unpack(state.p_DT)).norm());
  const double far = limits.max_speed * 1e-9 * (state.since_ns + static_cast<double>(period_ns));
  const bool jumped = state.started && moved > far;
  state.hold_ns =
      jumped ? static_cast<double>(limits.jump_hold_ns) : std::max(state.hold_ns - elapsed, 0.0);
  if (!state.started || sequence != state.sequence || moved > 0) {
    state.p_DE = pack(pose.p_DE);
    state.p_DT = pack(pose.p_DT);
    state.sequence = sequence;
    state.since_ns = 0;
    state.started = 1;
  }
  return state.hold_ns <= 0;
}

}  // namespace palpa::haptics
