#pragma once

#include <vtkNew.h>

#include <memory>
#include <vector>

#include "scene/panels.h"
#include "scene/scene_state.h"

class vtkImageData;
class vtkRenderer;
class vtkTexture;

namespace palpa::scene {

/// Throws Error when size and pixels of a picture disagree.
void checkPicture(const Image& picture);

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

class vtkRenderer;
class vtkRenderWindow;

namespace palpa::scene {

/// The camera's picture without the overlay, at the lower right of a panel, a quarter as wide: an
/// overlay must not take from the real scene what it hides.
class CameraInset {
 public:
  explicit CameraInset(vtkRenderWindow& window);
  ~CameraInset();
  void show(const Image* picture, const Rect& panel, int window_width,
            int window_height);  ///< null: nothing

 private:
  vtkRenderWindow& window_;
  vtkNew<vtkRenderer> frame_, picture_;  // its edge, the picture in it
  Backdrop backdrop_;
};

/// Where it lies, edge included.
Rect insetRect(const Rect& panel, int picture_width, int picture_height);

}  // namespace palpa::scene

class vtkRenderer;

namespace palpa::scene {

/// Real things in the camera's picture that hide what is drawn behind them: they fill the depths
/// and leave the colours, which are the picture's. Drawn before everything else of their renderer.
class Occluders {
 public:
  explicit Occluders(vtkRenderer& renderer);
  ~Occluders();
  /// Nothing is hidden where there is no picture.
  void update(const std::vector<Occluder>& things, bool picture);

 private:
  struct Thing;
  vtkRenderer& renderer_;
  std::vector<std::unique_ptr<Thing>> things_;
};

}  // namespace palpa::scene
