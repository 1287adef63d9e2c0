#include "scene/renderer_setup.h"

#include <vtkActor.h>
#include <vtkCullerCollection.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkRenderer.h>

namespace palpa::scene {
namespace {

class PassMapper : public vtkOpenGLPolyDataMapper {
 public:
  static PassMapper* New();
  vtkTypeMacro(PassMapper, vtkOpenGLPolyDataMapper);

  bool colours = true, depths = true;

  void RenderPiece(vtkRenderer* renderer, vtkActor* actor) override {
    vtkOpenGLState* state =
        static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow())->GetState();
    if (!colours) state->vtkglColorMask(0, 0, 0, 0);
    if (!depths) state->vtkglDepthMask(0);
    Superclass::RenderPiece(renderer, actor);
    if (!colours) state->vtkglColorMask(1, 1, 1, 1);
    if (!depths) state->vtkglDepthMask(1);
  }
};
vtkStandardNewMacro(PassMapper);

}  // namespace

vtkSmartPointer<vtkPolyDataMapper> makePassMapper() { return vtkSmartPointer<PassMapper>::New(); }

void setWrites(vtkMapper& mapper, bool colours, bool depths) {
  PassMapper& pass = static_cast<PassMapper&>(mapper);
  pass.colours = colours;
  pass.depths = depths;
}

void setUpRenderer(vtkRenderer& renderer, const Rgb& background) {
  // Hardly anything is ever out of sight, and to find that out costs the bounds of everything that
  // has changed, in every frame.
  renderer.GetCullers()->RemoveAllItems();
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
