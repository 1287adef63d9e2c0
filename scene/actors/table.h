#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "anatomy/patient.h"
#include "scene/actors/surface_map.h"

class vtkRenderer;

namespace palpa::scene {

/// How much light a table loses where things stand on it, for light from the whole sky. Texels of a
/// square, row by row; 0: none, 1: all.
struct GroundShade {
  int texels = 0;
  std::vector<float> dark;
  float at(int column, int row) const {
    return dark[static_cast<std::size_t>(row) * static_cast<std::size_t>(texels) +
                static_cast<std::size_t>(column)];
  }
};

/// What these meshes (A, m) take from the plane y = `table_y`, in the square of `half` about
/// `middle` (x, z): their outline from above, blurred by a third of their height, and darker where
/// they touch. A picture of a shadow, [chosen] by eye, not a computation of light.
GroundShade groundShade(const std::vector<const anatomy::TriangleMesh*>& meshes, double table_y,
                        const Eigen::Vector2d& middle, double half);

/// The plane under a patient's skin (up is -y of A), and the square of it that is a table.
struct TableTop {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  ///< x, z
  double y = 0, half = 0.4;
};
/// Nothing for a patient without a skin.
std::optional<TableTop> tableUnder(const anatomy::Patient& patient);

/// What a patient lies on where there is no camera's picture: a plane through the lowest point
/// (up is -y of A), with the shadow; it fades out into the background.
class Table {
 public:
  Table(vtkRenderer& renderer, const anatomy::Patient& patient);
  void setVisible(bool visible) { sheet_.setVisible(visible && laid_); }

 private:
  PictureSheet sheet_;
  bool laid_ = false;  ///< there is something that can lie on it
};

}  // namespace palpa::scene
