#include "apps/session/needle_session.h"
#include "apps/training/trial_words.h"

#include <cstdio>

#include "anatomy/base/error.h"
#include "apps/evidence/recorded_show.h"
#include "apps/runtime/executive.h"
#include "apps/session/mouse_hands.h"
#include "apps/session/output_folder.h"
#include "apps/session/stage.h"

namespace palpa::session {
namespace {

constexpr std::uint64_t kDemonstrationSeed = 7001;
constexpr std::int64_t kPlaybackPeriod = 16'666'667;
constexpr std::int64_t kLinger = 3 * runtime::kSecond;

/// A recorded trial, told to the scene at the speed at which it happened.
class Playback final : public runtime::Activity {
 public:
  Playback(std::vector<replay::NeedleMoment> moments, runtime::Bus& bus,
           task_needle::TaskChannels& channels, runtime::Executive& executive)
      : moments_(std::move(moments)), bus_(bus), channels_(channels), executive_(executive) {}
  const char* name() const override { return "playback"; }

  std::int64_t step(std::int64_t now_ns) override {
    trial::UserRequest request;
    while (channels_.requests_to_task.pop(&request))
      if (request.command == trial::UserCommand::start ||
          request.command == trial::UserCommand::quit ||
          request.command == trial::UserCommand::escape)
        executive_.stop();
    if (start_ns_ < 0) start_ns_ = now_ns;
    const double t_s = static_cast<double>(now_ns - start_ns_) * 1e-9;
    const std::size_t at = replay::momentAt(moments_, t_s);
    if (at + 1 == moments_.size() &&
        (end_ns_ = end_ns_ < 0 ? now_ns : end_ns_, now_ns - end_ns_ > kLinger))
      executive_.stop();
    publish(moments_[at], now_ns);
    return now_ns + kPlaybackPeriod;
  }

 private:
  void publish(const replay::NeedleMoment& moment, std::int64_t now_ns) {
    task_needle::TaskStatus status = replay::statusAt(moment, 1, true);
    status.role = training::Role::demonstration;
    status.notice =
        "Demonstration by a simulated expert, drawn without the camera. Enter: your turn";
    bus_.haptic_to_scene.publish(moment.tool, now_ns);
    channels_.status_to_scene.publish(status, now_ns);
  }

  std::vector<replay::NeedleMoment> moments_;
  runtime::Bus& bus_;
  task_needle::TaskChannels& channels_;
  runtime::Executive& executive_;
  std::int64_t start_ns_ = -1, end_ns_ = -1;
};

}  // namespace

void showDemonstration(const SessionOptions& options, NeedleWorld& world,
                       const std::filesystem::path& folder) {
  std::fprintf(stderr, "Preparing the expert's demonstration ...\n");
  SessionOptions expert = options;
  expert.command = "demonstration";
  expert.role = training::Role::demonstration;
  expert.who = OperatorKind::expert;
  expert.knows_patient = !options.patient.empty();  // one shows what one has prepared
  expert.seed = kDemonstrationSeed;
  expert.trials = 1;
  expert.trainee = "simulated-expert";
  expert.live.clear();
  expert.film_room.clear();  // in virtual time, and of the session's trials alone
  expert.records.clear();    // what was shown is nobody's trial
  expert.fast = expert.no_views = expert.quiet = true;
  expert.display = scene::Display::offscreen;
  expert.headset = false;
  const std::filesystem::path place = makeOutputFolder((folder / "demonstration").string(), "");
  if (runNeedleSession(expert, world, place).quit)
    throw Error("was interrupted", "the demonstration", "Start again");
  const evidence::RecordedNeedleTrial recorded(place / "session.palpa", 1);

  const DesktopStage stage = makeStage(options, world.patient, true);
  const auto executive = runtime::makeRealExecutive();
  runtime::Bus bus(executive->mode());
  task_needle::TaskChannels channels(executive->mode());
  Playback playback(recorded.trial.moments, bus, channels, *executive);
  task_needle::NeedleSceneSetup shown;
  trial::TrialScene::Stage& setup = shown.stage;
  setup.views = trial::TrialScene::Views::continuous;
  setup.view = stage.view.get();
  setup.camera = world.station.camera;
  setup.X_WA = world.X_WA;
  setup.X_WD = world.station.X_WD;
  setup.mark = "DEMONSTRATION: SIMULATED EXPERT";
  setup.shown = shownIn(options);
  setup.input = [&](const scene::ViewInput& input, std::int64_t) {
    trial::handleKeys(input, channels, bus.stop);
  };
  task_needle::NeedleScene scene(shown, bus, channels);
  executive->add(playback, {0, false, false});
  executive->add(scene, {1, false, true});
  executive->run();
}

}  // namespace palpa::session
