#include "apps/replay/player.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace palpa::replay {
namespace {

constexpr double kFrame = 0.04;  // s

double within(double speed) { return std::clamp(speed, kSlowest, kFastest); }

}  // namespace

Player::Player(double from_s, double to_s, double speed)
    : from_s_(from_s), to_s_(std::max(from_s, to_s)), at_s_(from_s), speed_(within(speed)) {}

void Player::moveTo(double t_s) { at_s_ = std::clamp(t_s, from_s_, to_s_); }

void Player::advance(double seconds) {
  if (paused_) return;
  moveTo(at_s_ + seconds * speed_);
  if (at_s_ >= to_s_) paused_ = true;
}

void Player::key(const std::string& name, const std::string& typed, bool shift) {
  static const std::map<std::string, double> kJumps{
      {"Left", -1}, {"Right", 1}, {"Down", -5}, {"Up", 5}};
  if (const auto jump = kJumps.find(name); jump != kJumps.end()) {
    if (shift) paused_ = true;
    moveTo(at_s_ + (shift ? std::copysign(kFrame, jump->second) : jump->second));
  }
  if (name == "Home") moveTo(from_s_);
  if (name == "End") moveTo(to_s_);
  if (typed == "plus" || typed == "equal" || typed == "KP_Add")
    speed_ = within(speed_ * std::sqrt(2.0));
  if (typed == "minus" || typed == "KP_Subtract") speed_ = within(speed_ / std::sqrt(2.0));
  if (name == "Escape" || name == "q") left_ = true;
  if (name != "space") return;
  if (at_s_ >= to_s_) moveTo(from_s_);
  paused_ = !paused_;
}

std::string Player::words() const {
  if (paused_) return "paused";
  char text[24];
  std::snprintf(text, sizeof text, "x %.3g", speed_);
  return text;
}

}  // namespace palpa::replay
