#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene/overlay/label.h"
#include "scene/panels.h"
#include "scene/scene_state.h"

class vtkRenderer;

namespace palpa::scene {

/// Size of ordinary text for a window of this height.
int textSize_px(int window_height);
/// What the strip of a replay takes of the view's lower edge, without its margin.
int stripHeight_px(int window_height);

/// Words over the AR view: the phase at the top left, the mark at the top right; readings at the
/// bottom left, where no syringe is held, over the legend of the force arrows; the notice at the
/// bottom centre; of a replay a strip below them.
class HudPainter {
 public:
  explicit HudPainter(
      vtkRenderer& renderer,
      ForceColours colours = ForceColours::paper);  ///< the renderer covers the whole window
  ~HudPainter();

  /// Lays everything out again, only when something changed.
  void update(const Hud& text, const std::vector<ForceArrow>& forces, const Rect& panel,
              int window_height);

 private:
  struct Content;
  struct Row {
    std::string name, value;
  };
  void build();
  void buildPhase();
  void buildReadings();
  void buildMark();
  void buildLegend();
  void buildScale();
  void buildNotice();
  void buildTimeline();
  std::vector<Row> readings() const;
  void write(const std::string& text, const TextStyle& style, int x, int y, Align align);
  TextStyle style(double scale, bool bold, const Rgb& colour) const;
  TextStyle fitted(const std::string& text, TextStyle wish, int width) const;

  Plates plates_;
  vtkRenderer& renderer_;
  ForceColours colours_;
  std::vector<std::unique_ptr<Label>> labels_;
  std::size_t used_ = 0;
  std::unique_ptr<Content> content_;
  int margin_ = 10, text_ = 14;
  int below_ = 0;  ///< top of what comes next at the left
  int above_ = 0;  ///< bottom of what comes next at the bottom
  Rect readings_;  ///< their plate; as wide as a pixel: none
};

}  // namespace palpa::scene
