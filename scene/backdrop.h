#pragma once

#include <vtkNew.h>

#include "scene/scene_state.h"

class vtkImageData;
class vtkRenderer;
class vtkTexture;

namespace palpa::scene {

/// A picture behind everything a renderer draws, stretched over its viewport.
class Backdrop {
 public:
  Backdrop(vtkRenderer& renderer, bool smooth);
  ~Backdrop();

  void show(const Image& picture);  ///< throws Error when size and pixels disagree
  void hide();

 private:
  vtkRenderer& renderer_;
  vtkNew<vtkImageData> image_;
  vtkNew<vtkTexture> texture_;
};

}  // namespace palpa::scene
