#pragma once

#include <memory>
#include <vector>

#include "apps/replay/needle_moments.h"
#include "apps/replay/recorded_pictures.h"
#include "apps/replay/trial_replay.h"
#include "apps/task_needle/task_words.h"

namespace palpa::replay {

/// A recorded needle trial, ready to be shown at any moment.
struct NeedleTrial : ShownTrial {
  task_needle::TaskWords words;
  std::vector<Moment> moments;  ///< not empty
  double length_s() const { return moments.back().t_s; }
};

/// `pictures` of the camera, shown in the view's inset; null: none. All outlive what is answered.
std::unique_ptr<TrialReplay> needleReplay(const NeedleTrial& trial, scene::SceneView& view,
                                          RecordedPictures* pictures = nullptr);

}  // namespace palpa::replay
