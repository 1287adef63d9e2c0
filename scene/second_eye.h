#pragma once

#include <vtkNew.h>

class vtkRenderer;
class vtkRenderWindow;

namespace palpa::scene {

/// The other eye of a view: the same actors and background as the first eye's four renderers,
/// another camera.
class SecondEye {
 public:
  SecondEye(vtkRenderWindow& window, vtkRenderer& behind, vtkRenderer& glass, vtkRenderer& on_skin,
            vtkRenderer& above);
  ~SecondEye();

  /// After the first eye's renderers were brought up to date.
  void mirror();
  vtkRenderer& behind() { return *behind_; }  ///< its camera is that of all four

  template <class Do>
  void forAll(Do act) {
    act(*behind_);
    act(*glass_);
    act(*on_skin_);
    act(*above_);
  }

 private:
  vtkRenderWindow& window_;
  vtkRenderer &first_behind_, &first_glass_, &first_on_skin_, &first_above_;
  vtkNew<vtkRenderer> behind_, glass_, on_skin_, above_;
};

}  // namespace palpa::scene
