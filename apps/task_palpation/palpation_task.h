#pragma once

#include <array>
#include <optional>
#include <vector>

#include "apps/assess/dose_counter.h"
#include "apps/assess/palpation/palpation_sample.h"
#include "apps/task_palpation/guidance.h"
#include "apps/task_palpation/palpation_file.h"
#include "apps/task_palpation/sensor_check.h"
#include "apps/training/trial_clock.h"
#include "apps/training/trial_words.h"
#include "apps/trial/trial_status.h"
#include "apps/trial/trial_task.h"
#include "haptics/loop/tick_config.h"

namespace palpa::task_palpation {

/// Makes of recorded ticks what a palpation is judged by; the same for a session and for its
/// replay. Place, along the top: the point of the round tip, on whose end T is, that is nearest to
/// it or deepest in it. How hard it is pressed: what the hand has to hold against along the top's
/// normal there, the real thing and the device together. A mark:
/// button 1 of the device goes down while the tip is not above the phantom's top by more than
/// `kOver`; beside the area, too, where it is a false alarm. Of two tools each is felt for itself;
/// the first one's clock and button count.
class PalpationListener {
 public:
  static constexpr std::uint32_t kMark = 1;  ///< bit of DeviceReading::buttons
  /// m above the top, at which a button still means the phantom
  static constexpr double kOver = 0.010;
  /// `pair`: of two tools
  explicit PalpationListener(const haptics::TickConfig& config,
                             const std::optional<haptics::PairConfig>& pair = {});

  void begin(std::uint32_t trial);  ///< everything so far is forgotten
  /// Counts while the trial is on and the force may be rendered. True for a sample that was kept
  /// (one in 10 ms).
  bool add(const haptics::FlightRecord& record);
  /// What was said of the mark with this number, from 1; 0: the last one. Figures of 0: of that
  /// nothing was said.
  void grade(double diameter, int hardness, int mobility, std::size_t mark = 0);

  double seconds() const { return clock_.seconds(); }  ///< of the trial, pauses left out
  const std::vector<assess::PalpationSample>& samples() const { return samples_; }
  const std::vector<assess::LumpMark>& marks() const { return marks_; }

 private:
  Vec3 tipMiddle(const haptics::FlightRecord& record) const;  // P

  std::array<Pose, 2> X_PD_;  // of each device
  Pose X_ET_;
  TopShape top_;
  double radius_;
  std::uint32_t trial_ = 0;
  training::TrialClock clock_;
  std::array<std::int64_t, 2> kept_ns_{-1, -1};
  bool pressed_ = false;
  std::vector<assess::PalpationSample> samples_;
  std::vector<assess::LumpMark> marks_;
};

struct PalpationPlan {
  training::Role role = training::Role::scored;
  std::uint64_t seed = 1;
  bool force_feedback = true;
  bool augmented = false;  ///< the task's augmentations add force
};

/// What stays of a trial: its ticks are in the evidence.
struct CompletedPalpation {
  assess::PalpationAssessment assessment;
  std::string reason;  ///< why aborted or void
};

/// A lump that is seen through the surface, in P; m.
struct SeenLump {
  Vec3 p_P = Vec3::Zero();
  double radius = 0;
  bool found = false;
  bool normal = false;  ///< belongs there
};

/// What the task tells the scene.
struct PalpationStatus : trial::TrialStatus {
  int columns = 0, rows = 0;
  /// of the coverage map, row by row from the trainee away; empty: it is not shown
  std::vector<std::uint8_t> levels;
  std::vector<Vec3> marks_P;
  std::vector<SeenLump> lumps;  ///< seen through the surface
  std::optional<Vec3> lead_P;   ///< where guidance leads
  double pressed_N = 0;
  int level = 0;  ///< of this pressure: 0 to 3
};

struct PalpationChannels : trial::Channels {
  explicit PalpationChannels(runtime::TimeMode mode) : status_to_scene(mode) {}
  runtime::StateChannel<PalpationStatus> status_to_scene;
};

/// What a palpation's trials are made of.
struct PalpationTaskSetup {
  const PalpationSettings& settings;
  haptics::TickConfig tick;
  std::optional<haptics::PairConfig> pair;  ///< of two tools
  bool simulated = false, automatic = true;
  bool see_through = false;  ///< the lumps while a trial runs: a demonstration
  bool guided = false;
  std::string not_scored;  ///< why; empty: scored
  std::vector<PalpationPlan> plan;
  std::vector<runtime::BoardPlace> places;
};

/// The palpation's trials: a case each, marks by the button, grades by word, coverage, time limit,
/// score. The case is told to the loop, and to the scene once the trial is over.
class PalpationTask final : public trial::TrialTask {
 public:
  PalpationTask(const PalpationTaskSetup& setup, runtime::Bus& bus, PalpationChannels& channels,
                runtime::Executive& executive);

  const std::vector<CompletedPalpation>& completed() const { return completed_; }

 private:
  std::string notReady(const haptics::FlightRecord& last) const override;
  runtime::TrialHeader begin(std::int64_t now_ns) override;
  Conclusion conclude(training::Outcome outcome, const std::string& reason) override;
  void watch(const haptics::FlightRecord& record) override { last_of_[record.tool & 1] = record; }
  void judge(const haptics::FlightRecord& record, std::int64_t now_ns) override;
  void command(haptics::TickCommands& commands) const override;
  void publishStatus(std::int64_t now_ns) override;
  std::string doing() const override;
  void receive(const trial::UserRequest& request, std::int64_t now_ns) override;
  void showLumps(const assess::PalpationAssessment* judged);
  const TopShape& top() const { return setup_.settings.scoring.rules.area.top; }
  const PalpationPlan& plan() const {
    return setup_.plan[static_cast<std::size_t>(status().trial - 1)];
  }

  PalpationTaskSetup setup_;
  PalpationChannels& channels_;
  PalpationListener listener_;
  assess::TrialDoses doses_;
  std::array<SensorCheck, 2> sensors_;  // of each tool
  std::array<haptics::FlightRecord, 2> last_of_;
  assess::CoverageMap map_;
  Guidance guidance_;
  Case case_;
  haptics::PlacedLumps placed_{};
  PalpationStatus shown_;
  std::vector<CompletedPalpation> completed_;
};

/// How hard the finger presses that presses harder, N, by the newest samples.
double pressing(assess::PalpationSamples samples);
/// As the scene shows it: of a pressure, 0 to 3; of each cell of the map, row by row from the
/// trainee away.
int levelOf(const assess::PressureLevels& levels, double f_N);
std::vector<std::uint8_t> levelsOf(const assess::CoverageMap& map);

/// What is recorded of a score.
std::string scoreJson(const assess::PalpationAssessment& assessment);

/// The lumps of a case as its event in the record says them, and read again; the replay's truth.
/// `taken_away`: a real one is not felt. Throws Error for invalid words.
std::string caseText(const std::vector<assess::CaseLump>& lumps, bool taken_away = false);
std::vector<assess::CaseLump> caseOf(const std::string& text);
bool takenIn(const std::string& text);

}  // namespace palpa::task_palpation
