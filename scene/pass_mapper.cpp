#include "scene/pass_mapper.h"

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

}  // namespace palpa::scene
