#pragma once

#include <Eigen/Core>
#include <vector>

#include "scene/panels.h"

namespace palpa::scene {

/// What words must not cover, pixels of the window, origin bottom left.
struct Surroundings {
  /// A straight part of the tool: its axis, and how far it reaches to the sides.
  struct Part {
    Eigen::Vector2d from, to;
    double half_width = 1;
    std::size_t eye = 0;  ///< who sees it so: each eye's tool counts alone
  };
  std::vector<Part> tool;
  std::vector<Eigen::Vector2d> points;  ///< its tip, and where it went in

  Surroundings movedBy(const Eigen::Vector2d& px) const;
  void add(const Surroundings& more);  ///< as the other eye sees it
};

/// The part of the tool's area, as it is seen in `panel`, that lies under a plate; 0 to 1.
double shareUnder(const Rect& plate, const Surroundings& surroundings, const Rect& panel);
/// Of the tool; together, too. 5 % are promised: the tool is known here by its axis and some places
/// across it.
inline constexpr double kMostCovered = 0.04;
/// A plate covers no point, nor more of the tool than that.
bool isClear(const Rect& plate, const Surroundings& surroundings, const Rect& panel);
/// The plate on the panel's other side.
Rect mirrored(const Rect& plate, const Rect& panel);

}  // namespace palpa::scene
