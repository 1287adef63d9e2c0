#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "apps/bench/pictures/picture_change.h"

namespace palpa::bench {

/// A needle on its syringe as it lies in a picture: on a straight line, whose places s are pixels
/// from the hub's middle, positive toward the plunger.
struct ToolInPicture {
  Eigen::Vector2d hub_px, along;  ///< a point of the line; unit
  double tip = 0;                 ///< s where the needle ends
  double needle_end = 0;          ///< s where the hub begins
  struct Width {
    double s = 0, px = 0;
  };
  std::vector<Width> barrel;         ///< across the line, along the barrel
  std::optional<double> ring, tint;  ///< s of a ring about the needle, of its change of colour

  Eigen::Vector2d at(double s) const { return hub_px + s * along; }
  Eigen::Vector2d across() const { return {-along.y(), along.x()}; }
};

/// Told from what has changed since a picture of the same view without a tool.
std::optional<ToolInPicture> toolIn(const PictureChange& change);

}  // namespace palpa::bench
