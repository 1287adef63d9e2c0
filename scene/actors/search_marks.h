#pragma once

#include <vtkSmartPointer.h>

#include <memory>
#include <vector>

#include "anatomy/geometry/pose.h"
#include "scene/scene_state.h"

namespace palpa::scene {

/// Who looks, for what has its size on the screen or faces the eye. A parallel view is one from far
/// away.
struct Sight {
  Pose X_CA = Pose::Identity();
  double focal_px = 1000;  ///< in window pixels
  /// Metres by which what must never be hidden is drawn nearer to the eye; for parallel views,
  /// where nobody sees it
  double before = 0;

  Vec3 eye() const { return X_CA.inverse().translation(); }
  /// Of C in A, turned so that x is right, y up, z toward the eye.
  Mat3 facing() const {
    const Mat3 R_AC = X_CA.linear().transpose();
    Mat3 R;
    R << R_AC.col(0), -R_AC.col(1), -R_AC.col(2);
    return R;
  }
  double metresPerPixel(const Vec3& p_A) const {
    const double z = (X_CA * p_A).z();
    return (z > 0.05 ? z : 0.05) / focal_px;
  }
};

}  // namespace palpa::scene

class vtkPolyData;
class vtkRenderer;

namespace palpa::scene {

/// What lies inside: translucent balls, each with its outline as the eye sees it. Found: yellow,
/// the outline closed. Not found: vermilion, the outline dashed. Normal: gray, the outline closed.
class LumpBalls {
 public:
  /// `through`: after the translucent skin, with the depths of what is opaque, so that a tool hides
  /// them. `above`: where a solid skin would.
  LumpBalls(vtkRenderer& through, vtkRenderer& above, double ring_px);
  ~LumpBalls();

  void update(const std::vector<ShownLump>& lumps, const Sight& sight, bool solid_skin);
  bool any() const { return shown_ > 0; }

 private:
  struct LumpBall;
  vtkRenderer &through_, &above_;
  double ring_px_;
  vtkSmartPointer<vtkPolyData> sphere_, ring_, dashes_;
  std::vector<std::unique_ptr<LumpBall>> balls_;
  std::size_t shown_ = 0;
};

}  // namespace palpa::scene

class vtkRenderer;

namespace palpa::scene {

/// Places somebody has marked: pins as on maps, numbered from 1, upright and of one size on the
/// screen.
class Pins {
 public:
  explicit Pins(vtkRenderer& renderer);
  ~Pins();

  /// `head_px`: radius of a pin's head.
  void update(const std::vector<Vec3>& places_A, const Sight& sight, double head_px);
  bool any() const { return shown_ > 0; }

 private:
  struct Pin;
  vtkRenderer& renderer_;
  std::vector<std::unique_ptr<Pin>> pins_;
  std::size_t shown_ = 0;
};

}  // namespace palpa::scene
