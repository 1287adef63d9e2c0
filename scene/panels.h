#pragma once

/// Where the views lie in the window. Pixels, origin at the window's bottom left (OpenGL).
namespace palpa::scene {

/// Beside the AR view: none; one of front, side and top (SceneState::fixed_view); all three.
enum class FixedViews { none, one, three };

struct Rect {
  int x = 0, y = 0, width = 1, height = 1;

  int right() const { return x + width; }
  int top() const { return y + height; }
  bool contains(double px, double py) const {
    return px >= x && px < right() && py >= y && py < top();
  }
  bool operator==(const Rect&) const = default;
};

/// Three fixed views: AR view on the left (70 % of the width), front, side and top one above the
/// other on the right, thin gaps between them. One: each on the right half. None: AR view alone.
struct Panels {
  Rect ar, front, side, top;
};
Panels layoutPanels(int width, int height, FixedViews fixed_views);

/// The largest rectangle in `panel` with the aspect ratio of a picture, centred.
Rect letterbox(const Rect& panel, int picture_width, int picture_height);

}  // namespace palpa::scene
