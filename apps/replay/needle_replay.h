#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/replay/needle_moments.h"
#include "apps/replay/recorded_pictures.h"
#include "apps/task_needle/task_words.h"
#include "scene/scene_view.h"

namespace palpa::replay {

/// Something to see on the way: a tick on the strip, words when it happens.
struct Mark {
  double t_s = 0;
  scene::TickTone tone = scene::TickTone::neutral;
  std::string words;
};

/// A recorded needle trial, ready to be shown at any moment.
struct NeedleTrial {
  int number = 1;
  bool force_feedback = true;
  Pose X_AD = Pose::Identity();
  task_needle::TaskWords words;
  std::string mark;                  ///< "SIMULATED EXPERT, REPLAY"
  std::vector<Moment> moments;       ///< not empty
  std::vector<Mark> marks;           ///< in their order
  double length_s() const { return moments.back().t_s; }
};

/// Shows a trial through the same scene that showed it when it happened; the board's camera is replaced by a fixed view of the patient, in a window one
/// that can be walked around. The view outlives it; one thread.
class NeedleReplay {
 public:
  /// `pictures` of the camera, shown in the view's inset; null: none.
  NeedleReplay(const NeedleTrial& trial, scene::SceneView& view, RecordedPictures* pictures = nullptr);
  ~NeedleReplay();
  /// Draws the moment; `rate`: how it is played, in words.
  void show(double t_s, const std::string& rate);
  /// Keys and mouse since the last frame of a window.
  const scene::ViewInput& input() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// How long words of a mark stay, s of the trial.
inline constexpr double kMarkShown = 1.5;

/// The words of the latest mark that is still to be seen; empty: none.
std::string wordsAt(const std::vector<Mark>& marks, double t_s);

}  // namespace palpa::replay
