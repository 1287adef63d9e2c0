#include "scene/panels.h"

#include <algorithm>
#include <cmath>

namespace palpa::scene {
namespace {

constexpr double kArShare = 0.7, kArShareOfTwo = 0.5;
constexpr int kGap_px = 2;

}  // namespace

Panels layoutPanels(int width, int height, FixedViews fixed_views) {
  Panels panels;
  const double share = fixed_views == FixedViews::three ? kArShare
                       : fixed_views == FixedViews::one ? kArShareOfTwo
                                                        : 1;
  const int ar_width = static_cast<int>(std::lround(share * width));
  panels.ar = {0, 0, ar_width, height};
  const int x = ar_width + kGap_px;
  const int column = std::max(1, width - x);
  if (fixed_views == FixedViews::one) {
    panels.front = panels.side = panels.top = {x, 0, column, height};
    return panels;
  }
  const int y1 = height / 3, y2 = 2 * height / 3;
  panels.top = {x, 0, column, std::max(1, y1)};
  panels.side = {x, y1 + kGap_px, column, std::max(1, y2 - y1 - kGap_px)};
  panels.front = {x, y2 + kGap_px, column, std::max(1, height - y2 - kGap_px)};
  return panels;
}

Rect letterbox(const Rect& panel, int picture_width, int picture_height) {
  const double scale = std::min(static_cast<double>(panel.width) / picture_width,
                                static_cast<double>(panel.height) / picture_height);
  const int width =
      std::clamp(static_cast<int>(std::lround(scale * picture_width)), 1, panel.width);
  const int height =
      std::clamp(static_cast<int>(std::lround(scale * picture_height)), 1, panel.height);
  return {panel.x + (panel.width - width) / 2, panel.y + (panel.height - height) / 2, width,
          height};
}

}  // namespace palpa::scene
