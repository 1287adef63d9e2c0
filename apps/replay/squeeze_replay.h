#pragma once

#include <array>
#include <memory>
#include <vector>

#include "apps/replay/trial_replay.h"
#include "apps/task_squeeze/squeeze_listener.h"

namespace palpa::replay {

struct SqueezeMoment {
  double t_s = 0;  ///< since the trial's start; pauses do not count
  std::array<runtime::ToolState, 2> tools;
  int thing = 0;  ///< 0 or 1: which of the two is felt
  double squeezed_N = 0;
  bool held = false;
};

/// A recorded comparison, ready to be shown at any moment.
struct SqueezeTrial : ShownTrial {
  Pose X_AD2 = Pose::Identity();  ///< the second device's base
  Vec3 middle_A = Vec3::Zero();   ///< of the object at rest
  task_squeeze::Comparison comparison;
  std::vector<SqueezeMoment> moments;  ///< not empty
  double length_s() const { return moments.back().t_s; }
};

/// Takes both tools' ticks in their order and keeps of one trial a moment every 4 ms.
class SqueezeReader {
 public:
  SqueezeReader(double touch_N, const std::array<Pose, 2>& X_ET,
                const task_squeeze::Comparison& comparison, int trial);
  void add(const haptics::FlightRecord& record);
  const std::vector<SqueezeMoment>& moments() const { return moments_; }

 private:
  std::array<Pose, 2> X_ET_;
  task_squeeze::SqueezeListener listener_;
  std::uint32_t trial_;
  runtime::ToolState first_;
  std::vector<SqueezeMoment> moments_;
};

/// The trial and the view outlive what is answered.
std::unique_ptr<TrialReplay> squeezeReplay(const SqueezeTrial& trial, scene::SceneView& view);

}  // namespace palpa::replay
