#pragma once

#include <memory>

#include "scene/scene_state.h"

class vtkRenderer;

namespace palpa::scene {

/// The last step of a view: what was drawn so far, over black of alpha 0, is laid over the camera's
/// picture as that camera would have seen it (Fischer, Bartz, Strasser 2006; Klein, Murray 2010):
///
///     o = blur(smooth(drawn)),  alpha a
///     pixel = a black + (white - black) o + grain sqrt(a (2 - a)) + (1 - a) picture
///
/// smooth: jagged edges (Lottes 2009), of colours times alpha. blur: a Gaussian of the camera's
/// width, where something differs within its reach. The grain is as strong as the camera's beneath
/// what is opaque, and together with the picture's own where it shines through. Where nothing was
/// drawn the picture stays what it is, bit for bit. Without a picture: edges are smoothed, alpha is
/// 1.
class Compositor {
 public:
  /// Works at the end of this renderer, on its part of the window.
  explicit Compositor(vtkRenderer& last);
  ~Compositor();

  /// Before a frame; null: no picture; `smooth`: jagged edges of what was drawn. Throws Error when
  /// size and pixels disagree.
  void show(const Image* picture, const CameraLook& look, bool smooth);
  void setOn(bool on);
  void shadeCreases();  ///< from now on (creases.h), before edges are smoothed

 private:
  class Pass;
  vtkRenderer& renderer_;
  std::unique_ptr<Pass, void (*)(Pass*)> pass_;
};

}  // namespace palpa::scene
