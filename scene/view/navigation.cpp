#include "scene/view/navigation.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "scene/window/keyboard.h"

namespace palpa::scene {

namespace {
constexpr double kHighest = 85 * std::numbers::pi / 180;
constexpr double kHalfAngle = 15 * std::numbers::pi / 180;
constexpr double kWidestShare = 0.85;  // a narrow view keeps the region's width in sight
constexpr double kClosestOrbit = 0.1, kFarthestOrbit = 1.5;  // metres
}  // namespace

OrbitCamera::OrbitCamera(const Vec3& target_A, double azimuth, double elevation, double distance)
    : view_{target_A, azimuth, elevation, distance}, home_(view_) {}

void OrbitCamera::orbit(double d_azimuth, double d_elevation) {
  view_.azimuth += d_azimuth;
  view_.elevation = std::clamp(view_.elevation + d_elevation, -kHighest, kHighest);
}

void OrbitCamera::zoom(double factor) {
  view_.distance = std::clamp(view_.distance * factor, kClosestOrbit, kFarthestOrbit);
}

void OrbitCamera::pan(double right, double down) {
  const Mat3 R_AC = X_CA().linear().transpose();
  view_.target_A -= view_.distance * (right * R_AC.col(0) + down * R_AC.col(1));
}

void OrbitCamera::reset() { view_ = home_; }

Pose OrbitCamera::X_CA() const {
  const double ce = std::cos(view_.elevation);
  const Vec3 back(ce * std::sin(view_.azimuth), -ce * std::cos(view_.azimuth),
                  std::sin(view_.elevation));  // from the target to the eye
  const Vec3 ahead = -back;
  const Vec3 right = ahead.cross(Vec3::UnitZ()).normalized();
  Mat3 R_AC;
  R_AC << right, ahead.cross(right), ahead;
  return makePose(R_AC, view_.target_A + view_.distance * back).inverse();
}

Pinhole OrbitCamera::pinhole(int width, int height) const {
  const double side = std::min<double>(height, kWidestShare * width);
  const double f = 0.5 * side / std::tan(kHalfAngle);
  return {width, height, f, f, 0.5 * width - 0.5, 0.5 * height - 0.5};
}

void Navigation::apply(const ViewInput& input, const Rect& view, int window_height,
                       OrbitCamera& camera) {
  const bool pressed = input.middle_button || input.right_button;
  const double dx = (input.mouse_x - x_) / view.height;
  const double dy = (input.mouse_y - y_) / view.height;
  x_ = input.mouse_x;
  y_ = input.mouse_y;
  if (!pressed || !dragging_) {
    dragging_ = pressed && view.contains(input.mouse_x, window_height - 1 - input.mouse_y);
    return;
  }
  if (input.shift) {
    camera.pan(dx, dy);
  } else if (input.middle_button) {
    camera.orbit(-std::numbers::pi * dx, std::numbers::pi * dy);  // a drag of one height: 180°
  } else {
    camera.zoom(std::exp2(2 * dy));
  }
}

struct WindowInput::Events {
  vtkNew<vtkRenderWindowInteractor> interactor;
  vtkNew<vtkCallbackCommand> listener;
  std::unique_ptr<Keyboard> keyboard;
  ViewInput now;

  static void receive(vtkObject*, unsigned long event, void* self, void*) {
    static_cast<Events*>(self)->take(event);
  }
  void take(unsigned long event);
  void press(unsigned long event);
};

void WindowInput::Events::press(unsigned long event) {
  switch (event) {
    case vtkCommand::LeftButtonPressEvent:
      now.left_button = true;
      break;
    case vtkCommand::LeftButtonReleaseEvent:
      now.left_button = false;
      break;
    case vtkCommand::MiddleButtonPressEvent:
      now.middle_button = true;
      break;
    case vtkCommand::MiddleButtonReleaseEvent:
      now.middle_button = false;
      break;
    case vtkCommand::RightButtonPressEvent:
      now.right_button = true;
      break;
    case vtkCommand::RightButtonReleaseEvent:
      now.right_button = false;
      break;
    default:
      break;
  }
}

void WindowInput::Events::take(unsigned long event) {
  press(event);
  switch (event) {
    case vtkCommand::ExitEvent:
      now.closed = true;
      return;
    case vtkCommand::MouseWheelForwardEvent:
      now.wheel += 1;
      break;
    case vtkCommand::MouseWheelBackwardEvent:
      now.wheel -= 1;
      break;
    default:
      break;
  }
  const int* position = interactor->GetEventPosition();
  now.mouse_x = position[0];
  now.mouse_y = interactor->GetSize()[1] - 1 - position[1];
  now.shift = interactor->GetShiftKey() != 0;
  now.control = interactor->GetControlKey() != 0;
}

WindowInput::WindowInput(vtkRenderWindow& window) : events_(std::make_unique<Events>()) {
  events_->listener->SetClientData(events_.get());
  events_->listener->SetCallback(&Events::receive);
  auto& interactor = *events_->interactor;
  interactor.SetRenderWindow(&window);
  interactor.SetInteractorStyle(nullptr);
  interactor.EnableRenderOff();  // frames are drawn by SceneView::show alone
  for (const auto event :
       {vtkCommand::ExitEvent, vtkCommand::KeyPressEvent, vtkCommand::MouseMoveEvent,
        vtkCommand::MouseWheelForwardEvent, vtkCommand::MouseWheelBackwardEvent,
        vtkCommand::LeftButtonPressEvent, vtkCommand::LeftButtonReleaseEvent,
        vtkCommand::MiddleButtonPressEvent, vtkCommand::MiddleButtonReleaseEvent,
        vtkCommand::RightButtonPressEvent, vtkCommand::RightButtonReleaseEvent})
    interactor.AddObserver(event, events_->listener);
  interactor.Initialize();
  events_->keyboard =
      std::make_unique<Keyboard>(reinterpret_cast<std::uintptr_t>(window.GetGenericWindowId()));
}

/// VTK keeps every interactor in a list until its loop has ended, and asks all of them for events:
/// this one too, when its window is gone. The window itself is not ours to close.
WindowInput::~WindowInput() {
  vtkRenderWindowInteractor& interactor = *events_->interactor;
  interactor.RemoveObserver(events_->listener);
  interactor.ProcessEvents();  // what is left is of this window
  vtkRenderWindow& window = *interactor.GetRenderWindow();
  interactor.SetRenderWindow(nullptr);
  window.SetInteractor(nullptr);
  interactor.SetDone(true);
  interactor.ProcessEvents();
}

ViewInput WindowInput::poll() {
  events_->interactor->ProcessEvents();
  ViewInput result = events_->now;
  for (PressedKey& press : events_->keyboard->pressed()) {
    result.keys.push_back(std::move(press.name));
    result.typed.push_back(std::move(press.typed));
  }
  events_->now.wheel = 0;
  return result;
}

const KeyPrints& WindowInput::prints() const { return events_->keyboard->prints(); }

}  // namespace palpa::scene
