#pragma once

#include <optional>
#include <vector>

#include "apps/assess/dose_counter.h"
#include "apps/task_palpation/guidance.h"
#include "apps/task_palpation/palpation_file.h"
#include "apps/task_palpation/palpation_listener.h"
#include "apps/task_palpation/sensor_check.h"
#include "apps/trial/grade.h"
#include "apps/trial/trial_task.h"

namespace palpa::task_palpation {

struct PalpationPlan {
  std::string role = "scored";
  std::uint64_t seed = 1;
  bool force_feedback = true;
  bool augmented = false;  ///< the task's augmentations add force
};

struct CompletedPalpation {
  assess::PalpationAssessment assessment;
  std::vector<assess::PalpationSample> samples;
  std::string reason;  ///< why aborted or void
};

/// What the task tells the scene.
struct PalpationStatus : trial::TrialStatus {
  int columns = 0, rows = 0;
  std::vector<std::uint8_t>
      levels;  ///< of the coverage map, row by row from the trainee away; empty: it is not shown
  std::vector<Vec3> marks_P;
  struct Shown {
    Vec3 p_P = Vec3::Zero();
    double radius = 0;
    bool found = false;
    bool normal = false;  ///< belongs there
  };
  std::vector<Shown> lumps;    ///< seen through the surface
  std::optional<Vec3> lead_P;  ///< where guidance leads
  double pressed_N = 0;
  int level = 0;  ///< of this pressure: 0 to 3
};

struct PalpationChannels : trial::Channels {
  explicit PalpationChannels(runtime::TimeMode mode) : status_to_scene(mode) {}
  runtime::StateChannel<PalpationStatus> status_to_scene;
};

/// The palpation's trials: a case each, marks by the button, grades by word, coverage, time limit,
/// score. The case is told to the loop, and to the scene once the trial is over.
class PalpationTask final : public trial::TrialTask {
 public:
  struct Setup {
    const PalpationSettings& settings;
    haptics::TickConfig tick;
    bool simulated = false, automatic = true;
    bool see_through = false;  ///< the lumps while a trial runs: a demonstration
    bool guided = false;
    std::string not_scored;  ///< why; empty: scored
    std::vector<PalpationPlan> plan;
    std::vector<runtime::BoardPlace> places;
  };
  PalpationTask(const Setup& setup, runtime::Bus& bus, PalpationChannels& channels,
                runtime::Executive& executive);

  const std::vector<CompletedPalpation>& completed() const { return completed_; }

 private:
  std::string notReady(const haptics::FlightRecord& last) const override;
  runtime::TrialHeader begin(std::int64_t now_ns) override;
  Conclusion conclude(const std::string& outcome, const std::string& reason) override;
  void judge(const haptics::FlightRecord& record, std::int64_t now_ns) override;
  void command(haptics::TickCommands& commands) const override;
  void publishStatus(std::int64_t now_ns) override;
  void hear(const trial::UserRequest& request, std::int64_t now_ns) override;
  void showLumps(const assess::PalpationAssessment* judged);
  const PalpationPlan& plan() const {
    return setup_.plan[static_cast<std::size_t>(status().trial - 1)];
  }

  Setup setup_;
  PalpationChannels& channels_;
  PalpationListener listener_;
  assess::TrialDoses doses_;
  SensorCheck sensor_;
  assess::CoverageMap map_;
  Guidance guidance_;
  Case case_;
  haptics::PlacedLumps placed_{};
  PalpationStatus shown_;
  std::vector<CompletedPalpation> completed_;
};

/// As the scene shows it: of a pressure, 0 to 3; of each cell of the map, row by row from the
/// trainee away.
int levelOf(const assess::PressureLevels& levels, double f_N);
std::vector<std::uint8_t> levelsOf(const assess::CoverageMap& map);

/// What is recorded of a score.
std::string scoreJson(const assess::PalpationAssessment& assessment);

/// The lumps of a case as its event in the record says them, and read again; the replay's truth.
/// Throws Error for words that are none.
std::string caseText(const std::vector<assess::CaseLump>& lumps);
std::vector<assess::CaseLump> caseOf(const std::string& text);

}  // namespace palpa::task_palpation
