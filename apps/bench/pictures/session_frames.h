#pragma once

#include <cstddef>

#include "anatomy/patient.h"
#include "scene/scene_state.h"

namespace palpa::bench {

/// Mesa draws nothing from here on: its drivers take every call and leave it at that. Others know
/// nothing of it. Before the first context.
void leaveOutDrawing();

std::size_t trianglesOf(const anatomy::Patient& patient);

/// A session's frames: picture, translucent skin, needle, arrows, words.
class SessionFrames {
 public:
  static constexpr int kWidth = 640, kHeight = 480;  ///< of the camera's picture

  static scene::CameraLook usualLook();  ///< of an ordinary webcam

  explicit SessionFrames(const anatomy::Patient& patient);

  /// Number i of a slow sway.
  const scene::SceneState& at(int i);
  /// So far that translucent surfaces are sorted anew.
  void moveEye(double sideways) { sideways_ = sideways; }
  /// As two eyes see it, `t_s` into the looking about of a person at work: up to 0.05 m/s, with
  /// the angles of a headset's pictures of this size.
  const scene::SceneState& forEyes(int i, double t_s, int width, int height);

 private:
  double work(int i);  ///< tool, arrows and words; how far the sway is
  scene::Image picture_;
  scene::SceneState state_;
  Vec3 entry_A_;
  double sideways_ = 0;
};

}  // namespace palpa::bench
