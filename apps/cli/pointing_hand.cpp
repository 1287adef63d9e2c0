#include "apps/cli/pointing_hand.h"

#include <algorithm>
#include <numbers>
#include <optional>
#include <utility>

#include "apps/runtime/clock.h"

namespace palpa::cli {
namespace {

constexpr double kOver = 0.006, kDeepest = 0.009;              // m above and below the top
constexpr double kPress = 0.012, kLift = 0.05, kAcross = 0.3;  // m/s
constexpr double kSmoothing = 0.03;                            // s, the mouse's steps become motion
constexpr double kMarkFor_s = 0.2;
constexpr std::int64_t kRepeats =
    800 * runtime::kMillisecond;  // a key that is held comes again sooner

/// The place of the plane z = 0 of P that is seen at the mouse; none outside the view, or where the
/// plane is seen from the side or from below.
std::optional<Vec3> pointedAt(const scene::ViewInput& input, const scene::ArGeometry& view,
                              const Pose& X_AP) {
  const double u = input.mouse_x, v = input.mouse_y;
  if (u < view.x || v < view.y || u >= view.x + view.width || v >= view.y + view.height)
    return std::nullopt;
  const Pose X_PC = (view.X_CA * X_AP).inverse();
  const Vec3 ray_P = X_PC.linear() * Vec3((u - view.camera.cx) / view.camera.fx,
                                          (v - view.camera.cy) / view.camera.fy, 1);
  const Vec3 eye_P = X_PC.translation();
  if (ray_P.z() > -1e-3 * ray_P.norm() || eye_P.z() <= 0) return std::nullopt;
  return Vec3(eye_P - eye_P.z() / ray_P.z() * ray_P);
}

}  // namespace

PointingHand::PointingHand(const Setup& setup) : setup_(setup) { wish_.y = -setup.half_y; }

void PointingHand::handle(const scene::ViewInput& input, const scene::ArGeometry& view,
                          std::int64_t now_ns) {
  const bool turns_view = input.right_button || input.middle_button;
  if (const std::optional<Vec3> p_P = pointedAt(input, view, setup_.X_AP); p_P && !turns_view) {
    wish_.x = std::clamp(p_P->x(), -setup_.half_x, setup_.half_x);
    wish_.y = std::clamp(p_P->y(), -setup_.half_y, setup_.half_y);
  }
  wish_.press = input.left_button;
  if (std::any_of(input.keys.begin(), input.keys.end(),
                  [](const std::string& key) { return key == "m" || key == "M"; })) {
    wish_.marks += now_ns - mark_key_ns_ > kRepeats;
    mark_key_ns_ = now_ns;
  }
  wishes_.publish(wish_, now_ns);
}

void PointingHand::move(const Wish& wish, double dt) {
  const Vec3 across(wish.x - tip_P_.x(), wish.y - tip_P_.y(), 0);
  const Vec3 step = std::min(1.0, dt / kSmoothing) * across;
  tip_P_ += std::min(1.0, kAcross * dt / std::max(step.norm(), 1e-12)) * step;
  const double wanted = wish.press ? -kDeepest : kOver,
               speed = wish.press && tip_P_.z() <= kOver ? kPress : kLift;
  tip_P_.z() += std::clamp(wanted - tip_P_.z(), -speed * dt, speed * dt);
}

twin::Hand::Action PointingHand::act(const Senses& senses, double dt) {
  if (!std::exchange(begun_, true))
    tip_P_ = setup_.X_DP.inverse() * (senses.X_DE * setup_.X_ET).translation();
  if (const Wish* wish = wishes_.read(senses.now_ns)) {
    move(*wish, dt);
    if (wish->marks != marked_) mark_left_s_ = kMarkFor_s;
    marked_ = wish->marks;
  }
  mark_left_s_ = std::max(0.0, mark_left_s_ - dt);
  Action action;
  action.buttons = mark_left_s_ > 0 ? 1u : 0u;
  const Mat3 down = Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()).toRotationMatrix();
  action.X_DH = setup_.X_DP * makePose(down, tip_P_) * setup_.X_ET.inverse();
  return action;
}

}  // namespace palpa::cli
