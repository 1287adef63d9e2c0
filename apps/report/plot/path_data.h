#pragma once

#include <string>
#include <vector>

namespace palpa::report {

/// The `d` of an SVG path of straight lines, in px to a tenth; short, because a page is mailed:
/// each point as the step from the one before, and none that lies on the line of its neighbours
/// within a tenth of a px.
class PathData {
 public:
  void moveTo(double x, double y);
  /// The first one of a path, or after `close`, moves.
  void lineTo(double x, double y);
  void close();
  /// What came so far.
  std::string str();

 private:
  struct Point {
    long x = 0, y = 0;  ///< tenths of a px
    bool operator==(const Point&) const = default;
  };
  static Point rounded(double x, double y);
  bool liesOnTheWayTo(const Point& to) const;
  void write();

  std::string d_;
  bool drawing_ = false, stepping_ = false;
  Point at_;                   ///< the last that is written
  std::vector<Point> passed_;  ///< since: on one line, within a tenth
};

}  // namespace palpa::report
