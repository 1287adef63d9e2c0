#pragma once

#include <vtkNew.h>

#include <Eigen/Core>
#include <array>

#include "scene/panels.h"
#include "scene/scene_state.h"

class vtkRenderer;
class vtkRenderWindow;

/// Two eyes: two perspective cameras of their own, never one picture shifted. A headset's are drawn
/// beside each other; those of a screen one after the other, each as large as the window, words and
/// fixed views too, and then made into one picture.
namespace palpa::scene {

/// Left and right of a camera, `apart` metres from each other along its x axis, axes parallel. The
/// principal points are shifted so that a point `focus` metres ahead is seen at the same pixel by
/// both: what is nearer stands before the screen.
///   X_EC: shift by +-apart/2;   cx_E = cx -+ fx apart / (2 focus)
std::array<EyeCamera, 2> stereoPair(const Pinhole& camera, const Pose& X_CA, double apart,
                                    double focus);

/// A headset's eyes in one window.
std::array<Rect, 2> halvesOf(const Rect& panel);

/// Where words go that both of a headset's eyes read: a rectangle 0.56 m x 0.36 m, a metre ahead of
/// the middle between them and a little above what they look at, as each eye's panel has it;
/// shifted alike for both into panels that see less.
std::array<Rect, 2> wordPanels(const std::array<EyeCamera, 2>& eyes,
                               const std::array<Rect, 2>& panels);

/// Whether a screen shows both eyes by one picture, made of two.
bool isMerged(Stereo stereo);
/// Of two of one size one as large.
///   anaglyph       for glasses red before the left eye, cyan before the right: red from the left
///                  picture's brightness, green and blue from the right one
///   side_by_side   for screens that halve a picture and stretch each half over all of it: the left
///                  eye's in the left half, as wide as half of it
///   top_bottom     the same with heights, the left eye's at the top
Image merged(const Image& left, const Image& right, Stereo stereo);
/// Where in an eye's picture lies what is seen here in theirs, pixels from the top left.
Eigen::Vector2d inEyesPicture(const Eigen::Vector2d& px, int width, int height, Stereo stereo);

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
