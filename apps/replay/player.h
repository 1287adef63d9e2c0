#pragma once

#include <string>

namespace palpa::replay {

/// Where in a recorded trial one is, and how fast it goes on; knows no clock and no picture.
///
///   space          pause, go on; at the end: from the start
///   Left, Right    1 s back, forward; with shift a frame of 40 ms, and pause
///   Down, Up       5 s back, forward
///   Home, End      to the start, the end
///   + -            faster, slower by sqrt 2; 0.1 to 10
///   Escape, q      leave
class Player {
 public:
  /// From `from_s` to `to_s` of the trial.
  Player(double from_s, double to_s, double speed);

  void advance(double seconds);  ///< of the viewer's time
  /// A key that was pressed, by its place's name and by what it typed (scene/view/scene_view.h).
  void key(const std::string& name, const std::string& typed, bool shift);
  double at_s() const { return at_s_; }
  double speed() const { return speed_; }
  bool paused() const { return paused_; }
  bool left() const { return left_; }
  std::string words() const;  ///< "x 0.5", "paused"

 private:
  void moveTo(double t_s);
  double from_s_, to_s_, at_s_, speed_;
  bool paused_ = false, left_ = false;
};

inline constexpr double kSlowest = 0.1, kFastest = 10;

}  // namespace palpa::replay
