#include "apps/task_needle/skin_follower.h"

#include <algorithm>
#include <cmath>

namespace palpa::task_needle {
namespace {

// [chosen] as the skin's shear in assets/materials/needle.json, N/m: the shaft drags the skin along
// its surface.
constexpr double kStiffness = 300;
constexpr double kMostDragged = 3e-3;  // m: then the shaft slips
constexpr double kRelaxing = 0.15;     // s
constexpr double kGone = 5e-5;         // m: nobody sees less
constexpr double kTouching =
    1e-6;  // m: from here on the way from the skin to the tip has a direction

}  // namespace

anatomy::SkinPush SkinFollower::pushed(const Pose& X_AT) const {
  const Vec3 tip = X_AT.translation();
  const anatomy::SurfacePoint foot = query_.closest(skin_, tip);
  anatomy::SkinPush push{foot.p_A, foot.n_A, 0, X_AT.rotation().col(2)};
  if (foot.distance > -kTouching) return push;
  push.depth = -foot.distance;
  push.n_A = (foot.p_A - tip) / push.depth;  // so that p - depth n is the tip
  return push;
}

double SkinFollower::dragged(const runtime::ToolState& tool, const Vec3& axis_A,
                             const Pose& X_AD) const {
  const double resisting = -(X_AD.rotation() * unpack(tool.f_contact_D)).dot(axis_A);
  const double bone = std::abs(tool.bone_force);  // bears on the tip, not on the skin
  const double left = std::max(std::abs(resisting) - bone, 0.0);
  return std::copysign(std::min(left / kStiffness, kMostDragged), resisting);
}

std::optional<anatomy::SkinPush> SkinFollower::follow(const runtime::ToolState& tool,
                                                      const Pose& X_AD, std::int64_t now_ns) {
  const Pose X_AT = X_AD * unpack(tool.X_DT);
  const double dt = 1e-9 * static_cast<double>(std::max<std::int64_t>(now_ns - last_ns_, 0));
  last_ns_ = now_ns;
  if (tool.phase == haptics::NeedlePhase::indenting) {
    push_ = pushed(X_AT);
    return push_;
  }
  const Vec3 axis = X_AT.rotation().col(2);
  double wanted = 0;
  if (tool.phase == haptics::NeedlePhase::inserted) {
    const anatomy::SurfacePoint entry = query_.closest(skin_, X_AD * unpack(tool.entry_D));
    const double was = push_ ? push_->depth : 0;
    push_ = anatomy::SkinPush{entry.p_A, entry.n_A, was, axis};
    wanted = dragged(tool, axis, X_AD);
  }
  if (!push_) return push_;
  push_->depth = wanted + (push_->depth - wanted) * std::exp(-dt / kRelaxing);
  if (tool.phase == haptics::NeedlePhase::outside && std::abs(push_->depth) < kGone) push_.reset();
  return push_;
}

}  // namespace palpa::task_needle
