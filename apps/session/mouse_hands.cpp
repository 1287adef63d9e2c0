#include "apps/session/mouse_hands.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "apps/runtime/clock.h"

namespace palpa::session {
namespace {

using trial::UserCommand;
constexpr double kMetresPerPixel = 0.00025;
constexpr double kMetresPerNotch = 0.001;
constexpr double kTurnPerKey = 0.035;  // rad, 2 degrees
constexpr double kSteepestTurn = 1.4;  // rad from the skin's normal
constexpr double kPlungerPerKey = 0.1;
constexpr double kAboveSkin = 0.015;  // m, where the needle waits
constexpr double kSmoothing = 0.03;   // s, the mouse's steps become motion
constexpr std::int64_t kControllerGone = 300 * runtime::kMillisecond;
constexpr std::int64_t kMousePeriod = runtime::kMillisecond;

const Vec3 kBevelUp(0, -1, 0.3);  // in A: no key turns the needle about itself

void send(trial::Channels& channels, UserCommand command, const std::string& reason = "") {
  channels.requests_to_task.push({command, reason});
}

}  // namespace

MouseHand::MouseHand(const MouseHandSetup& setup, runtime::ChannelDevice& device,
                     trial::Channels& channels, runtime::StopSwitch& stop)
    : setup_(setup), device_(device), channels_(channels), stop_(stop) {
  request_.tip_A = pack(setup.anatomy.entry_A);
  request_.along = -kAboveSkin;
  X_AT_ = pointedByMouse(request_);
}

void MouseHand::handle(const scene::ViewInput& input, std::int64_t now_ns) {
  trial::handleKeys(input, channels_, stop_);
  const auto leads = [](const std::string& key) {
    return key == "Left" || key == "Right" || key == "Up" || key == "Down";
  };
  const bool moved = (input.left_button && dragging_) || input.wheel != 0 ||
                     std::any_of(input.keys.begin(), input.keys.end(), leads);
  if (moved && now_ns - seen_ns_ > kControllerGone) letGo(now_ns);
  if (input.left_button && dragging_) {
    const double right = (input.mouse_x - mouse_x_) * kMetresPerPixel;
    const double up = -(input.mouse_y - mouse_y_) * kMetresPerPixel;
    // The screen's right is the patient's left in a supine view from the feet.
    request_.tip_A =
        pack(Vec3(unpack(request_.tip_A) + right * Vec3::UnitX() + up * Vec3::UnitZ()));
  }
  dragging_ = input.left_button;
  mouse_x_ = input.mouse_x;
  mouse_y_ = input.mouse_y;
  request_.along = std::clamp(request_.along + kMetresPerNotch * input.wheel, -0.05, 0.07);
  // The free hand is on the keyboard: Z and X for a right-handed trainee, comma and period for a
  // left.
  const std::string draw = setup_.left_handed ? "period" : "z";
  const std::string push = setup_.left_handed ? "comma" : "x";
  for (const std::string& key : input.keys) {
    if (key == "Left") request_.turn_medial -= kTurnPerKey;
    if (key == "Right") request_.turn_medial += kTurnPerKey;
    if (key == "Up") request_.turn_cephalad += kTurnPerKey;
    if (key == "Down") request_.turn_cephalad -= kTurnPerKey;
    if (key == draw) request_.plunger = std::min(1.0, request_.plunger + kPlungerPerKey);
    if (key == push) request_.plunger = std::max(0.0, request_.plunger - kPlungerPerKey);
  }
  request_.turn_medial = std::clamp(request_.turn_medial, -kSteepestTurn, kSteepestTurn);
  request_.turn_cephalad = std::clamp(request_.turn_cephalad, -kSteepestTurn, kSteepestTurn);
  requests_.publish(request_, now_ns);
}

void MouseHand::hold(const headset::HeldController& held, std::int64_t now_ns) {
  if (held.start) send(channels_, UserCommand::start);
  if (held.tracked) {
    seen_ns_ = now_ns;
    request_.held = true;
    request_.plunger = held.plunger;
    request_.X_AT = pack(held.X_AT);
  }
  requests_.publish(request_, now_ns);
}

void MouseHand::letGo(std::int64_t now_ns) {
  if (!std::exchange(request_.held, false)) return;
  request_.off = pack(Pose(unpack(request_.X_AT) * pointedByMouse(request_).inverse()));
  requests_.publish(request_, now_ns);
}

Pose MouseHand::pointedByMouse(const MouseRequest& request) const {
  const twin::VisibleAnatomy& a = setup_.anatomy;
  // "Right" turns the tip to the right of the screen, whichever side is punctured.
  const Vec3 screen_right = Vec3::UnitX() - Vec3::UnitX().dot(a.normal_A) * a.normal_A;
  const Vec3 axis_A = (-a.normal_A + std::tan(request.turn_medial) * screen_right.normalized() +
                       std::tan(request.turn_cephalad) * a.cephalad_A)
                          .normalized();
  return makePose(rotationWithZ(axis_A, kBevelUp), unpack(request.tip_A) + request.along * axis_A);
}

std::int64_t MouseHand::step(std::int64_t now_ns) {
  if (const MouseRequest* request = requests_.read(now_ns)) {
    const double share = 1e-3 / kSmoothing;
    const Pose wanted =
        request->held ? unpack(request->X_AT) : unpack(request->off) * pointedByMouse(*request);
    const Quat turned = Quat(X_AT_.rotation()).slerp(share, Quat(wanted.rotation())).normalized();
    X_AT_ = makePose(turned.toRotationMatrix(),
                     X_AT_.translation() + share * (wanted.translation() - X_AT_.translation()));
    plunger_ += share * (request->plunger - plunger_);
  }
  const Pose X_DE = setup_.X_DA * X_AT_ * setup_.X_ET.inverse();
  haptics::DeviceReading reading;
  reading.t_ns = now_ns;
  reading.sequence = ++sequence_;
  reading.p_DE = pack(Vec3(X_DE.translation()));
  reading.q_DE = pack(Quat(X_DE.rotation()));
  reading.plunger = plunger_;
  reading.homed = 1;
  device_.publish(reading, now_ns);
  due_ns_ = std::max((due_ns_ < 0 ? now_ns : due_ns_) + kMousePeriod, now_ns);
  return due_ns_;
}

namespace {

constexpr double kOver = 0.006, kDeepest = 0.009;              // m above and below the top
constexpr double kPress = 0.012, kLift = 0.05, kAcross = 0.3;  // m/s
constexpr double kFingerSmoothing = 0.03;                      // s, the mouse's steps become motion
constexpr double kMarkFor_s = 0.2;
constexpr std::int64_t kRepeats =
    800 * runtime::kMillisecond;  // a key that is held comes again sooner

/// Where a ray from the eye first goes into a curved top, at most half a metre on from where it
/// meets the plane z = 0.
std::optional<Vec3> meets(const TopShape& top, const Vec3& eye_P, const Vec3& ray_P) {
  constexpr double kStep = 1e-3, kBeyond = 0.5;  // m
  const Vec3 way = ray_P.normalized();
  const auto over = [&](double far) {
    const Vec3 p = eye_P + far * way;
    return p.z() - heightOf(top, p.x(), p.y()).z;
  };
  const double last = -eye_P.z() / way.z() + kBeyond;
  for (double far = std::max(0.0, last - 2 * kBeyond); far < last; far += kStep)
    if (over(far) <= 0) return Vec3(eye_P + far * way);
  return std::nullopt;
}

/// The place of the top in P that is seen at the mouse; none outside the view, or where the plane
/// z = 0 is seen from the side or from below.
std::optional<Vec3> pointedAt(const scene::ViewInput& input, const scene::ArGeometry& view,
                              const Pose& X_AP, const TopShape& top) {
  const double u = input.mouse_x, v = input.mouse_y;
  if (u < view.x || v < view.y || u >= view.x + view.width || v >= view.y + view.height)
    return std::nullopt;
  const Pose X_PC = (view.X_CA * X_AP).inverse();
  const Vec3 ray_P = X_PC.linear() * Vec3((u - view.camera.cx) / view.camera.fx,
                                          (v - view.camera.cy) / view.camera.fy, 1);
  const Vec3 eye_P = X_PC.translation();
  if (ray_P.z() > -1e-3 * ray_P.norm() || eye_P.z() <= 0) return std::nullopt;
  if (!top.flat()) return meets(top, eye_P, ray_P);
  return Vec3(eye_P - eye_P.z() / ray_P.z() * ray_P);
}

}  // namespace

PointingHand::PointingHand(const PointingHandSetup& setup) : setup_(setup) {
  request_.y = -setup.half_y;
}

void PointingHand::handle(const scene::ViewInput& input, const scene::ArGeometry& view,
                          std::int64_t now_ns) {
  const bool turns_view = input.right_button || input.middle_button;
  if (const std::optional<Vec3> p_P = pointedAt(input, view, setup_.X_AP, setup_.top);
      p_P && !turns_view) {
    request_.x = std::clamp(p_P->x(), -setup_.half_x, setup_.half_x);
    request_.y = std::clamp(p_P->y(), -setup_.half_y, setup_.half_y);
    if (setup_.to_area) {
      const Vec3 there = setup_.to_area(Vec3(request_.x, request_.y, 0));
      request_.x = there.x();
      request_.y = there.y();
    }
  }
  request_.press = input.left_button;
  if (std::count(input.keys.begin(), input.keys.end(), "m") > 0) {
    request_.marks += now_ns - mark_key_ns_ > kRepeats;
    mark_key_ns_ = now_ns;
  }
  requests_.publish(request_, now_ns);
}

void PointingHand::move(const PointingRequest& request, double dt) {
  const Vec3 across(request.x - tip_P_.x(), request.y - tip_P_.y(), 0);
  const Vec3 step = std::min(1.0, dt / kFingerSmoothing) * across;
  tip_P_ += std::min(1.0, kAcross * dt / std::max(step.norm(), 1e-12)) * step;
  const double wanted = request.press ? -kDeepest : kOver,
               speed = request.press && tip_P_.z() <= kOver ? kPress : kLift;
  tip_P_.z() += std::clamp(wanted - tip_P_.z(), -speed * dt, speed * dt);
}

twin::Hand::Action PointingHand::act(const Senses& senses, double dt) {
  if (!std::exchange(begun_, true))
    tip_P_ =
        alongTop(setup_.top, setup_.X_DP.inverse() * (senses.X_DE * setup_.X_ET).translation());
  if (const PointingRequest* request = requests_.read(senses.now_ns)) {
    move(*request, dt);
    if (request->marks != marked_) mark_left_s_ = kMarkFor_s;
    marked_ = request->marks;
  }
  mark_left_s_ = std::max(0.0, mark_left_s_ - dt);
  Action action;
  action.buttons = mark_left_s_ > 0 ? 1u : 0u;
  const Mat3 down = Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()).toRotationMatrix();
  const Mat3 turn = turnToNormal(normalOf(setup_.top, tip_P_.x(), tip_P_.y()));
  action.X_DH =
      setup_.X_DP * makePose(turn * down, fromTop(setup_.top, tip_P_)) * setup_.X_ET.inverse();
  return action;
}

}  // namespace palpa::session
