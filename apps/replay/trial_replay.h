#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "apps/runtime/bus.h"
#include "apps/trial/trial_scene.h"
#include "scene/view/scene_view.h"

namespace palpa::replay {

/// Something to see on the way: a tick on the strip, words when it happens.
struct StripMark {
  double t_s = 0;
  scene::TickTone tone = scene::TickTone::neutral;
  std::string words;
  bool near_miss = false;
};

/// How long words of a mark stay, s of the trial.
inline constexpr double kMarkShown = 1.5;

/// Moments are kept so far apart, s: more than any film shows.
inline constexpr double kMomentStep = 0.004;

/// The words of the latest mark that is still to be seen; empty: none.
std::string wordsAt(const std::vector<StripMark>& marks, double t_s);

/// The last of `moments`, which have a time `t_s` and stand in its order, at or before a time; or
/// the first.
template <class Moment>
std::size_t momentAt(const std::vector<Moment>& moments, double t_s) {
  std::size_t low = 0, high = moments.size();  // the answer is in [low, high)
  while (high - low > 1) (moments[(low + high) / 2].t_s <= t_s ? low : high) = (low + high) / 2;
  return low;
}

/// What every recorded trial has for being shown.
struct ShownTrial {
  int number = 1;
  bool force_feedback = true;
  Pose X_AD = Pose::Identity();
  std::string mark;              ///< "REPLAY: SIMULATED"
  std::vector<StripMark> marks;  ///< in their order
};

/// The tool as a record has it, for the scene.
runtime::ToolState toolIn(const haptics::FlightRecord& record, const Pose& X_ET);

/// Shows a recorded trial at any moment through the scene that showed it when it happened; the
/// board's camera is replaced by a fixed view of the patient, in a window one that can be walked
/// around. The view outlives it; one thread. What is particular to a task adds whoever derives from
/// this.
class TrialReplay {
 public:
  virtual ~TrialReplay() = default;
  TrialReplay(const TrialReplay&) = delete;
  TrialReplay& operator=(const TrialReplay&) = delete;

  /// Draws the moment; `rate`: how it is played, in words.
  void show(double t_s, const std::string& rate);
  /// Told of what is drawn, before it is, and may change it.
  void beforeEach(std::function<void(scene::SceneState&)> told) { told_ = std::move(told); }
  /// Keys and mouse since the last frame of a window.
  const scene::ViewInput& input() const { return input_; }

 protected:
  TrialReplay(const ShownTrial& trial, double length_s) : trial_(trial), length_s_(length_s) {}
  /// For the task's scene; W is A here.
  trial::TrialScene::Stage stage(scene::SceneView& view);
  /// Tells the scene tool and status of this moment.
  virtual void showAt(double t_s, std::int64_t now_ns) = 0;
  virtual trial::TrialScene& scene() = 0;
  /// What only this task's replay shows.
  virtual void add(scene::SceneState&, double) {}
  /// The status every task begins with.
  void fill(trial::TrialStatus& status, double elapsed_s) const;

  runtime::Bus bus_{runtime::TimeMode::virtual_time};

 private:
  void addStrip(scene::SceneState& state) const;

  const ShownTrial& trial_;
  double length_s_, at_s_ = 0;
  std::string rate_;
  std::int64_t now_ns_ = 0;
  scene::ViewInput input_;
  std::function<void(scene::SceneState&)> told_;
};

}  // namespace palpa::replay
