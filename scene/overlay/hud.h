#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "scene/overlay/clearance.h"
#include "scene/overlay/label.h"
#include "scene/panels.h"
#include "scene/scene_state.h"

class vtkRenderer;

namespace palpa::scene {

/// Size of ordinary text for a window of this height, on a desktop whose text is so much larger
/// than usual.
int textSize_px(int window_height, double scale = 1);
/// What the strip of a replay takes of the view's lower edge, without its margin.
int stripHeight_px(int text_px);

/// Words over the AR view: the phase at the top left, the mark at the top right; readings at the
/// bottom left, over the legend of the force arrows; the notice at the bottom centre; of a replay a
/// strip below them. Where a tool, its tip or its entry would be covered, what is above changes
/// sides, what is below too, and the notice goes up; where all readings have no room, the first
/// three; a plate that is in the way on either side is not drawn as long as it is, but for an
/// alarm. They stay where they are until they are in the way
/// again.
class HudPainter {
 public:
  explicit HudPainter(
      vtkRenderer& renderer,
      ForceColours colours = ForceColours::paper);  ///< the renderer covers the whole window
  ~HudPainter();

  /// Lays everything out again, only when something changed.
  void update(const Hud& text, const std::vector<ForceArrow>& forces, const Rect& panel,
              int text_px, const Surroundings& surroundings = {});

  /// Of all plates that are drawn now, the notice's last
  std::vector<Rect> plates() const;

 private:
  enum class Plate { phase, mark, legend, scale, readings, notice };
  struct Placed {
    Plate plate;
    Rect frame;
  };
  struct Content;
  struct Lines {
    std::vector<std::string> texts;
    TextStyle look;
    int width = 0, height = 0;  ///< px, of all
  };
  struct Row {
    std::string name, value;
  };
  void build();
  void makeWay(const Surroundings& surroundings);
  void hideTogether(const Surroundings& surroundings, std::set<Plate>* hidden) const;
  bool move(const Surroundings& surroundings);
  bool inTheWay(Plate first, Plate last, bool other_side, const Surroundings& surroundings) const;
  int startOf(int width, bool right) const;
  bool put(Plate plate, const Rect& frame);
  bool alarms() const;
  bool hasRoom(const Rect& frame) const;
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
  Lines fittedLines(const std::string& text, const TextStyle& wish, const TextStyle& alone,
                    int room) const;
  void write(const Lines& lines, int x, int top, Align align);

  Plates plates_;
  vtkRenderer& renderer_;
  ForceColours colours_;
  std::vector<std::unique_ptr<Label>> labels_;
  std::size_t used_ = 0;
  std::unique_ptr<Content> content_;
  Rect panel_;
  int margin_ = 10, text_ = 14;
  int below_ = 0;               ///< top of what comes next at the left
  int above_ = 0;               ///< bottom of what comes next at the bottom
  Rect readings_;               ///< their plate; as wide as a pixel: none
  std::vector<Placed> placed_;  ///< drawn or not
  std::set<Plate> hidden_;
  bool upper_right_ = false, lower_right_ = false;  ///< phase; readings and legend
  bool notice_up_ = false, few_readings_ = false;
  Rect all_readings_;      ///< where all of them would lie
  Rect notice_elsewhere_;  ///< where it would lie if it went up, or down again
};

}  // namespace palpa::scene
