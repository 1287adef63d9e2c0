#pragma once

#include <vtkNew.h>

#include <string>
#include <vector>

#include <Eigen/Core>

#include "scene/overlay/label.h"

class vtkActor2D;
class vtkPolyData;
class vtkRenderer;

namespace palpa::scene {

/// A name, and the place that it is of: pixels, origin bottom left.
struct NamedPlace {
  std::string name;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
};

/// Where a name stands, and its line from the name to the place.
struct PlacedName {
  NamedPlace of;
  Align align = Align::left;  ///< in the left column to the right, and the other way round
  int x = 0, y = 0;           ///< of the name, as Label takes them
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
};

/// The columns beside a picture: right ends of the names on its left, left ends of those on its
/// right, and what of the height they may take.
struct NameColumns {
  int left = 0, right = 0, bottom = 0, top = 0;
  int line = 20;  ///< what a name takes of the height
  int gap = 6;    ///< from a name to its line
};

/// Each name beside the half of the places where its own is, as near to its height as the others
/// let it be; no two lines of a column cross. Names that have no room are left out, the last first.
std::vector<PlacedName> placeNames(std::vector<NamedPlace> places, const NameColumns& columns);

/// Thin lines over a picture, each with a dot at its end.
class LeaderLines {
 public:
  LeaderLines(vtkRenderer& renderer, const Rgb& ink, double width_px);
  ~LeaderLines();
  void add(const Eigen::Vector2d& from, const Eigen::Vector2d& to);

 private:
  vtkNew<vtkPolyData> shape_;
  vtkNew<vtkActor2D> actor_;
  Plates dots_;
  Rgba ink_;
  int dot_px_;
};

}  // namespace palpa::scene
