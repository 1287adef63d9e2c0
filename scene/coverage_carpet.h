#pragma once

#include <vtkNew.h>

#include <optional>

#include "scene/lines.h"
#include "scene/scene_state.h"

class vtkActor;
class vtkImageData;
class vtkPolyData;
class vtkRenderer;

namespace palpa::scene {

/// What has been felt, as a translucent carpet just over the plane of its grid, and the outline of
/// the whole. Cells that were not felt stay clear. Without light, so that a level has one colour
/// wherever it lies.
class CoverageCarpet {
 public:
  CoverageCarpet(vtkRenderer& renderer, double outline_px);
  ~CoverageCarpet();

  /// Lays the carpet anew where the grid has changed, dyes it anew where levels have; else costs a
  /// comparison. A grid without as many levels as cells is not shown.
  void update(const std::optional<CoverageGrid>& grid, bool visible);
  bool visible() const;

 private:
  void lay(const CoverageGrid& grid);
  void dye(const CoverageGrid& grid);

  vtkNew<vtkPolyData> sheet_;
  vtkNew<vtkImageData> picture_;
  vtkNew<vtkActor> carpet_;
  EdgedLines outline_;
  std::optional<CoverageGrid> drawn_;
};

}  // namespace palpa::scene
