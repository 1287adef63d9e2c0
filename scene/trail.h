#pragma once

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <vector>

#include "anatomy/geometry/pose.h"

class vtkActor;
class vtkPolyData;
class vtkRenderer;

namespace palpa::scene {

/// The path of the needle's tip, one line shared by all views.
class Trail {
 public:
  Trail();
  ~Trail();

  vtkSmartPointer<vtkActor> addTo(vtkRenderer& renderer, double width_px);
  void update(const std::vector<Vec3>& path_A);  ///< cheap when the path has not changed

 private:
  vtkNew<vtkPolyData> line_;
  std::size_t drawn_ = 0;
  Vec3 last_A_ = Vec3::Zero();
};

}  // namespace palpa::scene
