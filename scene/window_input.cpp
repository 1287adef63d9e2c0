#include "scene/window_input.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>

#include <utility>

namespace palpa::scene {

struct WindowInput::Events {
  vtkNew<vtkRenderWindowInteractor> interactor;
  vtkNew<vtkCallbackCommand> listener;
  ViewInput now;

  static void hear(vtkObject*, unsigned long event, void* self, void*) {
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
    case vtkCommand::KeyPressEvent:
      if (const char* key = interactor->GetKeySym()) now.keys.emplace_back(key);
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
  events_->listener->SetCallback(&Events::hear);
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
}

WindowInput::~WindowInput() { events_->interactor->RemoveObserver(events_->listener); }

ViewInput WindowInput::poll() {
  events_->interactor->ProcessEvents();
  ViewInput result = events_->now;
  events_->now.keys.clear();
  events_->now.wheel = 0;
  return result;
}

}  // namespace palpa::scene
