#pragma once

#include <string>
#include <vector>

#include "haptics/flight_record.h"

namespace palpa::live {

/// What the hand feels, N: of a real thing (where a sensor can say) and of what is rendered,
/// together; without a sensor the computed contact.
double feltForce(const haptics::FlightRecord& record);

/// Force and depth of a trial, thinned for a picture: of every 20 ms the tick with the greatest
/// force.
class Curve {
 public:
  struct Point {
    double t_s = 0;  ///< session time
    double force_N = 0;
    double depth_mm = 0;  ///< under the skin; 0 for what has no needle
  };
  void add(const haptics::FlightRecord& record);
  /// The points that are complete since the last call, as an entry: {"kind": "curve", "trial",
  /// "t_s", "force_N", "depth_mm"}; empty: none.
  std::string take();
  const std::vector<Point>& points() const { return points_; }

 private:
  std::vector<Point> points_;
  std::int64_t slot_ = -1;
  Point best_;
  std::uint32_t trial_ = 0;
};

}  // namespace palpa::live
