#pragma once

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <optional>
#include <vector>

#include "anatomy/geometry/pose.h"
#include "scene/palette.h"
#include "scene/scene_state.h"

class vtkActor;
class vtkPolyData;
class vtkPolyDataMapper;
class vtkRenderer;

namespace palpa::scene {

/// Lines of constant width on the screen with a dark edge, so that they are seen on any background.
class EdgedLines {
 public:
  EdgedLines(vtkRenderer& renderer, const Rgb& colour, double width_px);
  ~EdgedLines();
  /// Each entry a line through its points.
  void show(const std::vector<std::vector<Vec3>>& lines_A);
  void setWidth(double width_px, double edge_px = 1.25);
  /// Over what is nearer as well, but for what its renderer draws later.
  void drawThrough();
  void hide();
  void setVisible(bool visible);  ///< what was shown last
  bool visible() const;

 private:
  vtkNew<vtkPolyData> shape_;
  vtkSmartPointer<vtkPolyDataMapper> mapper_;
  vtkNew<vtkActor> edge_, line_;
  std::vector<std::vector<Vec3>> shown_A_;
};

/// Where 95 % of a point's pixels lie, by the covariance of its place: the ellipse
///   d' (J S J')^-1 d = 5.99     J: the derivative of the projection
/// in the plane through the point parallel to the picture. Empty where it would be smaller than
/// `least_px`.
std::vector<Vec3> uncertaintyEllipse(const Mat3& covariance_A, const Vec3& p_A, const Pose& X_CA,
                                     const Pinhole& camera, double least_px = 2);

/// From `from` to `to` in dashes of 5 mm, 3 mm apart.
std::vector<std::vector<Vec3>> dashes(const Vec3& from, const Vec3& to);

}  // namespace palpa::scene

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
