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

void HudPainter::makeWay(const Surroundings& surroundings) {
  const auto better = [&](Plate first, Plate last) {
    return inTheWay(first, last, false, surroundings) && !inTheWay(first, last, true, surroundings);
  };
  const bool turn_upper = better(Plate::phase, Plate::mark),
             turn_lower = better(Plate::legend, Plate::readings),
             lift = inTheWay(Plate::notice, Plate::notice, false, surroundings) &&
                    isClear(notice_elsewhere_, surroundings, panel_);
  upper_right_ ^= turn_upper;
  lower_right_ ^= turn_lower;
  notice_up_ ^= lift;
  if (turn_upper || turn_lower || lift) build();
  std::set<Plate> hidden;
  for (const Placed& p : placed_)
    if (!isClear(p.frame, surroundings, panel_) && !(p.plate == Plate::notice && alarms()))
      hidden.insert(p.plate);
  if (hidden == hidden_) return;
  hidden_ = std::move(hidden);
  build();
}

std::vector<Rect> HudPainter::plates() const {
  std::vector<Rect> drawn;
  for (const Placed& p : placed_)
    if (!hidden_.contains(p.plate)) drawn.push_back(p.frame);
  return drawn;
}

}  // namespace palpa::scene
