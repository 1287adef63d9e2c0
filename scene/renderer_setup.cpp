#include "scene/renderer_setup.h"

#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

namespace palpa::scene {

void setUpRenderer(vtkRenderer& renderer, const Rgb& background) {
  renderer.SetBackground(background[0], background[1], background[2]);
  renderer.InteractiveOff();
  renderer.AutomaticLightCreationOff();
  vtkNew<vtkLight> light;
  light->SetLightTypeToCameraLight();
  light->SetPosition(-0.35, 0.45, 1);  // in units of the view: right, up, toward the viewer
  light->SetFocalPoint(0, 0, 0);
  renderer.AddLight(light);
}

void setViewport(vtkRenderer& renderer, const Rect& where, int window_width, int window_height) {
  renderer.SetViewport(static_cast<double>(where.x) / window_width,
                       static_cast<double>(where.y) / window_height,
                       static_cast<double>(where.right()) / window_width,
                       static_cast<double>(where.top()) / window_height);
}

}  // namespace palpa::scene
