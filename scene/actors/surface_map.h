#pragma once

#include <vtkNew.h>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "scene/palette.h"
#include "scene/scene_state.h"

class vtkActor;
class vtkImageData;
class vtkPolyData;
class vtkRenderer;

namespace palpa::scene {

/// A picture that lies on a surface in A, without light, drawn over what lies there: translucent
/// where its texels are. It leaves no depths.
class PictureSheet {
 public:
  explicit PictureSheet(vtkRenderer& renderer);
  ~PictureSheet();
  /// In across x along pieces; `at`: where the picture's (u, v) lies, each 0 to 1 from its lower
  /// left texel on.
  void lay(int across, int along, const std::function<Vec3(double u, double v)>& at);
  /// RGBA, width x height texels, from the lower left on.
  void dye(int width, int height, const std::vector<std::uint8_t>& rgba);
  void setVisible(bool visible);
  bool visible() const;

 private:
  vtkNew<vtkPolyData> sheet_;
  vtkNew<vtkImageData> picture_;
  vtkNew<vtkActor> actor_;
};

/// A map's colour, `share` of the way along its scale.
Rgb scaleColour(double share);
/// The least and the most of a map's values.
std::array<double, 2> rangeOf(const SurfaceMap& map);
/// What its colours mean, in two figures.
ColourScale scaleOf(const SurfaceMap& map);

/// A map of a figure on the plane of its grid, in the colours of one scale; paler, and hatched,
/// where it is hardly known.
class MapCarpet {
 public:
  explicit MapCarpet(vtkRenderer& renderer) : sheet_(renderer) {}
  /// A map without as many figures as nodes is not shown. Made once of each map.
  void update(const SurfaceMap* map, bool visible);
  bool visible() const { return sheet_.visible(); }

 private:
  PictureSheet sheet_;
  const SurfaceMap* drawn_ = nullptr;
};

}  // namespace palpa::scene
