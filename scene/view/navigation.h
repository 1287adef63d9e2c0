#pragma once

#include <memory>

#include "scene/key_places.h"
#include "scene/panels.h"
#include "scene/scene_state.h"
#include "scene/view/scene_view.h"

namespace palpa::scene {

/// The virtual camera of the AR view while no registered camera drives it: it looks at a point and
/// a person can walk it around. Azimuth about the patient's long axis (+z of A), 0 = straight in
/// front of the chest, positive toward the patient's left; elevation positive toward the head.
class OrbitCamera {
 public:
  OrbitCamera() = default;
  OrbitCamera(const Vec3& target_A, double azimuth, double elevation, double distance);

  void orbit(double d_azimuth,
             double d_elevation);       ///< radians; elevation stays short of the poles
  void zoom(double factor);             ///< distance times factor, 0.1 m to 1.5 m
  void pan(double right, double down);  ///< fractions of the distance
  void reset();                         ///< back to where it was made

  Pose X_CA() const;
  Pinhole pinhole(int width, int height) const;  ///< 30° high (wide, where narrow)

 private:
  struct View {
    Vec3 target_A = Vec3::Zero();
    double azimuth = 0, elevation = 0, distance = 0.5;
  };
  View view_, home_;
};

/// Dragging in the AR view walks the virtual camera: middle button around the entry point, right
/// button up and down nearer and farther; with Shift either one moves sideways. The left button and
/// the wheel belong to the program.
class Navigation {
 public:
  void apply(const ViewInput& input, const Rect& view, int window_height, OrbitCamera& camera);

 private:
  bool dragging_ = false;  // began inside the view
  double x_ = 0, y_ = 0;
};

}  // namespace palpa::scene

class vtkRenderWindow;

namespace palpa::scene {

/// Collects what a person does in an X window. VTK's own interactor styles are left out: there 'e'
/// and 'q' end the program and the mouse moves the camera behind our back.
class WindowInput {
 public:
  explicit WindowInput(vtkRenderWindow& window);  ///< after the window's first frame
  ~WindowInput();

  ViewInput poll();                 ///< everything since the last call
  const KeyPrints& prints() const;  ///< of the keyboard, as it was at the last poll

 private:
  struct Events;
  std::unique_ptr<Events> events_;
};

}  // namespace palpa::scene
