#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "anatomy/patient.h"
#include "scene/key_places.h"
#include "scene/panels.h"
#include "scene/scene_state.h"
#include "scene/window/gl_context.h"
#include "scene/window/pixels.h"

namespace palpa::scene {

/// What a person did in the window since the last call; positions in window pixels from the top
/// left.
struct ViewInput {
  bool closed = false;
  /// By place what bears a letter or a digit in the US layout ("p", "1", "comma";
  /// scene/key_places.h), other keys by X's symbol: "space", "Escape", "Left", "question"
  std::vector<std::string> keys;
  std::vector<std::string> typed;   ///< the same, by what they type in the layout that is on
  double mouse_x = 0, mouse_y = 0;  ///< where two eyes have one picture, in that of each
  double wheel = 0;                 ///< notches since the last call
  bool left_button = false, right_button = false, middle_button = false;
  bool shift = false, control = false;
};

struct ViewLayout {
  int width = 1280, height = 720;  ///< of a picture; a window is as large as it was made
  FixedViews fixed_views = FixedViews::three;
  bool free_navigation = true;  ///< drag the virtual camera; a protocol can switch it off
  /// The skin gives way where it is touched (AR view). Off where people are assessed: seeing must
  /// not replace feeling.
  bool skin_deflection = false;
  ForceColours force_colours = ForceColours::paper;
  Stereo stereo = Stereo::none;  ///< of the AR view
  Inset inset = Inset::none;
  /// What is not drawn is black and clear (alpha 0): for displays that one looks through
  bool see_through = false;
  bool inside = true;  ///< what lies under the skin is drawn
  /// Of the camera's picture the part where the work is, as large as it goes; else all of it
  bool framed = false;
  double text_scale = 1;  ///< of the desktop's text
  bool creases = false;   ///< darker (view/creases.h): where a graphics card draws
};

/// How the AR view (its left eye, in stereo) looks right now, in window pixels from the top left:
/// the pixel (u, v) under the mouse sees the ray ((u - cx) / fx, (v - cy) / fy, 1) of C.
struct ArGeometry {
  Pinhole camera;  ///< cx, cy count from the window's corner
  Pose X_CA = Pose::Identity();
  double x = 0, y = 0, width = 0, height = 0;  ///< the part of the window it covers
};

/// The window: AR view (picture, registered patient, needle with syringe, force arrows, legend,
/// HUD) beside fixed orthographic views. The context must outlive it; one thread only.
class SceneView {
 public:
  SceneView(GlContextProvider& context, const anatomy::Patient& patient, const ViewLayout& layout);
  ~SceneView();

  /// Updates the graph and renders one frame; keys in words as the keyboard prints them.
  void show(const SceneState& state);
  Image capture() const;  ///< the last frame, RGB, top row first
  /// The last frame of one eye (0 left, 1 right; a stereo view) into a texture of the same context.
  void copyEye(std::size_t eye, const TextureTarget& target) const;
  /// Events of an interactive window; empty otherwise. F11 fills the monitor, and again goes back.
  ViewInput poll();

  /// What the window's keyboard prints, as it was at the last poll; empty without a window: as US.
  KeyPrints keyPrints() const;

  ArGeometry arGeometry(std::size_t eye = 0) const;  ///< 1: the right one's, in stereo
  /// What words cover of the last frame (before each eye of a headset: of both), pixels of the
  /// window, origin bottom left.
  std::vector<Rect> wordPlates() const;
  void resetNavigation();  ///< the virtual camera back to where it began

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

void writePng(const Image& image, const std::string& file);  ///< beside, then renamed; throws Error

}  // namespace palpa::scene
