#pragma once

#include <vtkNew.h>

class vtkRenderer;
class vtkRenderWindow;

namespace palpa::scene {

/// The other eye of a view: the same actors and background as the first eye's three renderers, another camera.
class SecondEye {
 public:
  SecondEye(vtkRenderWindow& window, vtkRenderer& behind, vtkRenderer& glass, vtkRenderer& above);
  ~SecondEye();

  /// After the first eye's renderers were brought up to date.
  void mirror();
  vtkRenderer& behind() { return *behind_; }   ///< its camera is that of all three

  template <class Do>
  void forAll(Do act) {
    act(*behind_);
    act(*glass_);
    act(*above_);
  }

 private:
  vtkRenderWindow& window_;
  vtkRenderer &first_behind_, &first_glass_, &first_above_;
  vtkNew<vtkRenderer> behind_, glass_, above_;
};

}  // namespace palpa::scene
