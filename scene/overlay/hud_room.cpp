#include <algorithm>
#include <utility>

#include "scene/overlay/hud.h"

/// Where the words of the HUD have room beside a tool.
namespace palpa::scene {

/// Whether one of these plates is, where it lies or on the other side.
bool HudPainter::inTheWay(Plate first, Plate last, bool other_side,
                          const Surroundings& surroundings) const {
  return std::any_of(placed_.begin(), placed_.end(), [&](const Placed& p) {
    if (p.plate < first || p.plate > last) return false;
    return !isClear(other_side ? mirrored(p.frame, panel_) : p.frame, surroundings, panel_);
  });
}

bool HudPainter::hasRoom(const Rect& frame) const {
  return frame.x >= panel_.x && frame.right() <= panel_.right() && frame.y >= panel_.y &&
         frame.top() <= panel_.top();
}

void HudPainter::makeWay(const Surroundings& surroundings) {
  constexpr int kAtMost = 4;  // one move may make room for another
  for (int i = 0; i < kAtMost && move(surroundings); ++i) build();
  std::set<Plate> hidden;
  for (const Placed& p : placed_)
    if (!isClear(p.frame, surroundings, panel_) && !(p.plate == Plate::notice && alarms()))
      hidden.insert(p.plate);
  hideTogether(surroundings, &hidden);
  if (hidden == hidden_) return;
  hidden_ = std::move(hidden);
  build();
}

/// Plates of which each covers little may cover much together: the one that covers most goes first.
void HudPainter::hideTogether(const Surroundings& surroundings, std::set<Plate>* hidden) const {
  for (;;) {
    double all = 0, most = 0;
    Plate worst{};
    for (const Placed& p : placed_) {
      if (hidden->contains(p.plate)) continue;
      const double share = shareUnder(p.frame, surroundings, panel_);
      all += share;
      if (share <= most || (p.plate == Plate::notice && alarms())) continue;
      most = share;
      worst = p.plate;
    }
    if (all <= kMostCovered || most == 0) return;
    hidden->insert(worst);
  }
}

/// Whether anything is to lie elsewhere than it does.
bool HudPainter::move(const Surroundings& surroundings) {
  const auto better = [&](Plate first, Plate last) {
    return inTheWay(first, last, false, surroundings) && !inTheWay(first, last, true, surroundings);
  };
  const bool turn_upper = better(Plate::phase, Plate::mark),
             turn_lower = better(Plate::legend, Plate::readings),
             lift = inTheWay(Plate::notice, Plate::notice, false, surroundings) &&
                    isClear(notice_elsewhere_, surroundings, panel_);
  const bool all_fit = !hasRoom(all_readings_) || isClear(all_readings_, surroundings, panel_);
  const bool resize = !turn_lower && few_readings_ == all_fit;
  upper_right_ ^= turn_upper;
  lower_right_ ^= turn_lower;
  notice_up_ ^= lift;
  few_readings_ ^= resize;
  return turn_upper || turn_lower || lift || resize;
}

std::vector<Rect> HudPainter::plates() const {
  std::vector<Rect> drawn;
  for (const Placed& p : placed_)
    if (!hidden_.contains(p.plate)) drawn.push_back(p.frame);
  return drawn;
}

}  // namespace palpa::scene
