#pragma once

#include <vtkNew.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkTextureObject.h>

#include "scene/view/flat_pass.h"

class vtkRenderer;

namespace palpa::scene {

/// OBSCURANCE OF CREASES (McGuire, Mara, Luebke, "Scalable ambient obscurance", HPG 2012, eq. 1):
/// light from all around reaches less of a place between two surfaces. From the depths that were
/// drawn, of n places about p within r (m) of it, v from p to what is seen there, N the surface's
/// normal:
///
///     lit = max(0, 1 - 5 s / (n r^5) sum max(0, r^2 - v.v)^3 max(0, v.N - z / 10^4) / (v.v + e))
///
/// averaged over 4 x 4 pixels of about the same depth; colours are multiplied by it. What a
/// graphics card has time for, and a processor has not (`frame_cost` of `palpa bench render`).
class Creases {
 public:
  /// `drawn`, of `place` of the window, with this renderer's camera and the depths that the frame
  /// has now; alpha stays. Between FlatDrawing.
  vtkTextureObject& shade(vtkTextureObject& drawn, const FlatPlace& place, vtkRenderer& renderer);
  void release(vtkWindow* window);

 private:
  void prepare(vtkOpenGLRenderWindow& window, const FlatPlace& place);

  vtkNew<vtkTextureObject> depths_, lit_, shaded_;
  vtkNew<vtkOpenGLFramebufferObject> aside_;
  FlatQuad obscure_, darken_;
};

}  // namespace palpa::scene
