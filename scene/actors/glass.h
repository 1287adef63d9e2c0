#pragma once

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <array>
#include <cstdint>
#include <vector>

#include "anatomy/geometry/pose.h"

class vtkActor;
class vtkCellArray;
class vtkPolyData;
class vtkRenderer;
class vtkRenderWindow;

namespace palpa::scene {

/// An order by distance, in time that grows with the number alone (radix sort, two digits of eight
/// bits): what lies closer together than 1/65535 of the whole range counts as equally far.
class FarFirst {
 public:
  /// Indices of these distances, the largest first, of equal ones the first first; stays until the
  /// next one.
  const std::vector<std::uint32_t>& order(const std::vector<float>& distances);

 private:
  std::vector<std::uint16_t> keys_;
  std::vector<std::uint32_t> order_, next_;
};

/// Translucent surfaces over what a renderer has drawn, blended from the far to the near, in a pass
/// of its own that keeps colours and depths. Within a surface the triangles go by the distance of
/// their middles from the eye (Newell, Newell, Sancha 1972, without splitting), surfaces by the
/// nearest corner of their boxes, so that one around another comes after it. Only faces that look
/// at the eye are drawn. Exact where surfaces do not pass through each other and triangles are
/// small; depth peeling, which is exact always, draws everything once more for every layer.
///
/// Sorted anew when the eye has moved by a two-hundredth of its distance.
class Glass {
 public:
  /// Joins the window after `behind`, whose camera it shares.
  Glass(vtkRenderWindow& window, vtkRenderer& behind);
  ~Glass();

  /// `surface` is what the actor shows, by a mapper of `makePassMapper`; it has triangles only.
  void add(vtkActor* actor, vtkPolyData* surface);
  void remove(vtkActor* actor);
  /// What moves before all of them, by such a mapper too: drawn after them, unsorted.
  void addBefore(vtkActor* actor);
  /// Before a frame: the eye in the surfaces' frame.
  void look(const Vec3& eye);

  vtkRenderer& renderer() { return *renderer_; }

 private:
  struct Surface {
    vtkSmartPointer<vtkActor> actor;
    std::vector<std::array<long long, 3>> triangles;
    std::vector<Eigen::Vector3f> middles;
    Vec3 low, high;
    vtkSmartPointer<vtkCellArray> sorted;  ///< what is drawn: the triangles in their order
  };
  void sort(const Surface& surface, const Vec3& eye);
  void order(const Vec3& eye);

  vtkRenderWindow& window_;
  vtkNew<vtkRenderer> renderer_;
  std::vector<Surface> surfaces_;
  std::vector<vtkActor*> before_;
  FarFirst far_first_;
  std::vector<float> distances_;
  Vec3 sorted_for_;
  bool sorted_ = false;
};

}  // namespace palpa::scene
