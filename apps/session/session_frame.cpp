#include "apps/session/session_frame.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "anatomy/base/counted.h"
#include "anatomy/base/uuid.h"
#include "apps/evidence/told_events.h"
#include "apps/live/wire.h"
#include "apps/os/child_process.h"
#include "apps/os/system_time.h"
#include "apps/runtime/geometry_activity.h"
#include "apps/runtime/recorders.h"
#include "apps/session/session_facts.h"
#include "apps/session/session_igtl.h"
#include "apps/session/session_records.h"
#include "apps/session/session_watch.h"
#include "apps/session/terminal.h"
#include "scene/window/x11_window.h"

namespace palpa::session {
namespace {

live::Hello helloOf(const SessionOptions& o, const station::Station& station,
                    const std::string& uuid) {
  return {uuid,      o.task.empty() ? o.command : std::filesystem::path(o.task).stem().string(),
          o.trainee, isSimulated(o.who) || station.simulated,
          o.assess,  o.trials};
}

constexpr std::int64_t kEndPatience = 5 * runtime::kSecond;
constexpr const char* kLeftBehind = " did not answer at the end of the session and was left behind";

std::string listed(const runtime::Executive::Stuck& stuck) {
  std::string all;
  for (const std::string& name : stuck) all += (all.empty() ? "" : ", ") + partInWords(name);
  return all;
}

/// One that nothing follows: neither a study's next block, nor a trainee's session after what is
/// demonstrated.
bool standsAlone(const SessionOptions& options) {
  return options.study.id.empty() && options.role != training::Role::demonstration;
}

void sayTrouble(const std::string& words) { std::fprintf(stderr, "palpa: %s\n", words.c_str()); }

/// What the parts that still could have left for it goes into the evidence as well. Why not; empty:
/// it does.
std::string keepEvidence(runtime::RecorderActivity& recorder, record::SessionWriter& writer) {
  try {
    recorder.finish();
    writer.close();
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

/// A session of which something hangs: this program, anew, makes of its evidence what it owes.
[[noreturn]] void leaveBehind(const SessionOptions& options, const std::filesystem::path& folder) {
  if (!options.live.empty())  // nobody listens at them any more
    for (const std::string& socket : {options.live, live::stopSocketOf(options.live)}) {
      std::error_code ignored;
      std::filesystem::remove(socket, ignored);
    }
  if (standsAlone(options)) os::becomeAnew({"finish", folder.string()});
  sayTrouble("the report was not made, and nothing after it: palpa finish " + folder.string() +
             " makes it; then start again");
  std::_Exit(EXIT_FAILURE);
}

runtime::StepCosts* stepsOf(SessionCost* cost) {
  return cost && cost->by_stage ? &cost->steps : nullptr;
}

runtime::CameraActivity::Exposer timed(runtime::CameraActivity::Exposer exposer,
                                       SessionCost* cost) {
  if (!cost || !cost->by_stage) return exposer;
  return [exposer = std::move(exposer), cost](std::int64_t now_ns, std::uint64_t number) {
    return [exposure = exposer(now_ns, number), cost](const cv::Rect& part) {
      const std::int64_t before_ns = os::threadsProcessorTime_ns();
      std::optional<ar::Frame> frame = exposure(part);
      cost->drawing_ns += os::threadsProcessorTime_ns() - before_ns;
      return frame;
    };
  };
}

void runTimed(runtime::Executive& executive, SessionCost* cost) {
  if (!cost) return executive.run();
  cost->started_ns = os::processorTime_ns();
  const std::int64_t thread_ns = os::threadsProcessorTime_ns();
  executive.run();
  cost->thread_ns = os::threadsProcessorTime_ns() - thread_ns;
  cost->run_ns = os::processorTime_ns() - cost->started_ns;
}

/// Somebody else at the station (SessionOptions::meanwhile).
class Meanwhile final : public runtime::Activity {
 public:
  Meanwhile(const SessionOptions& options, trial::Channels& channels, runtime::StopSwitch& stop)
      : options_(options), channels_(channels), stop_(stop) {}
  const char* name() const override { return "meanwhile"; }
  std::int64_t step(std::int64_t now_ns) override {
    options_.meanwhile(now_ns, channels_, stop_);
    return now_ns + 10 * runtime::kMillisecond;
  }

 private:
  const SessionOptions& options_;
  trial::Channels& channels_;
  runtime::StopSwitch& stop_;
};

/// While it lives, a window that is gone ends the session and not the program.
class WindowWatch {
 public:
  explicit WindowWatch(std::function<void()> lost) { scene::whenWindowIsLost(std::move(lost)); }
  ~WindowWatch() { scene::whenWindowIsLost(nullptr); }
  WindowWatch(const WindowWatch&) = delete;
  WindowWatch& operator=(const WindowWatch&) = delete;
};

}  // namespace

SessionFrame::SessionFrame(const SessionOptions& options, const World& world,
                           SessionDevices::Hands hands, trial::Channels& channels,
                           const std::filesystem::path& folder)
    : options_(options),
      world_(world),
      channels_(channels),
      folder_(folder),
      window_(options.display == scene::Display::window && !options.no_views),
      pictures_(options, world.station),
      stage_(options.no_views ? DesktopStage{}
                              : makeStage(options, world.patient, window_, world.fixed_views)),
      executive_(options.fast ? runtime::makeVirtualExecutive(stepsOf(world.cost))
                              : runtime::makeRealExecutive()),
      mode_(executive_->mode()),
      stop_key_(window_ && mode_ == runtime::TimeMode::real ? stage_.context->stopKey() : nullptr),
      bus_(mode_),
      devices_(options, world.station, std::move(hands), bus_, channels, executive_->clock(),
               mode_) {}

std::vector<runtime::BoardPlace> SessionFrame::places() const {
  std::vector<runtime::BoardPlace> all;
  for (const station::OtherBoard& board : world_.station.boards)
    all.push_back({board.name, board.X_WB, board.tolerance});
  return all;
}

namespace {

trial::HeldBy heldBy(SessionDevices& devices) {
  return devices.mouse()      ? trial::HeldBy::mouse_needle
         : devices.pointing() ? trial::HeldBy::mouse_finger
                              : trial::HeldBy::device;
}

}  // namespace

trial::TrialScene::Stage SessionFrame::stage(scene::HeadDisplay* head) {
  using Views = trial::TrialScene::Views;
  trial::TrialScene::Stage stage;
  stage.views = !stage_.view                ? Views::none
                : window_ && !options_.fast ? Views::continuous
                                            : Views::pictures;
  stage.wanted = [this](std::int64_t now_ns) {
    return picture_wanted_ = live_ && !options_.fast && live_->wantsPicture(now_ns);
  };
  stage.view = stage_.view.get();
  stage.head = head;
  stage.camera = pictures_.camera();
  stage.X_WA = world_.X_WA;
  stage.X_WD = world_.station.X_WD;
  stage.mark = markFor(options_, world_.station);
  stage.shown = shownIn(options_);
  stage.folder = folder_;
  stage.every_source_picture = pictures_.photographs();
  stage.places = places();
  if (mayHear(options_) && (window_ || head))
    sound_.emplace(world_.heart_per_min, bus_.stop, executive_->clock());
  if (sound_ || !options_.live.empty())
    stage.watch = [this](const scene::SceneState& state, const trial::TrialStatus& status,
                         std::int64_t now_ns) { publish(state, status, now_ns); };
  if (!window_) return stage;
  stage.keys =
      trial::keysOf({world_.engine, heldBy(devices_), options_.left_handed,
                     stage.shown.skin == presentation::SkinLook::free,
                     stage.shown.views == presentation::FixedViews::one, sound_.has_value()});
  stage.input = [this](const scene::ViewInput& input, std::int64_t now_ns) {
    trial::handleKeys(input, channels_, bus_.stop);
    if (sound_) remark(sound_->handle(input.keys));
    if (PointingHand* hand = devices_.pointing())
      hand->handle(input, stage_.view->arGeometry(), now_ns);
    notePlace(now_ns);  // asks the window system, which may take its time: last
  };
  return stage;
}

/// On the thread that draws: once the session is over, its window may be gone.
void SessionFrame::notePlace(std::int64_t now_ns) {
  constexpr std::int64_t kSeldom_ns = 2'000'000'000;
  if (place_ && now_ns - place_asked_ns_ < kSeldom_ns) return;
  place_ = stage_.context->place();
  place_asked_ns_ = now_ns;
}

/// Goes into the evidence, in words; empty: nothing does.
void SessionFrame::remark(const std::string& words) {
  if (!words.empty()) channels_.requests_to_task.push({trial::UserCommand::remark, words});
}

/// To whoever hears it, and to whoever looks on; without views, in words only.
void SessionFrame::publish(const scene::SceneState& state, const trial::TrialStatus& status,
                           std::int64_t now_ns) {
  if (sound_) remark(sound_->see(state, status, now_ns));
  if (!live_) return;
  const scene::KeyPrints prints = stage_.view ? stage_.view->keyPrints() : scene::KeyPrints();
  live_->show(scene::withKeys(state.hud, prints), status, now_ns);
  if (stage_.view && picture_wanted_) live_->picture(stage_.view->capture(), now_ns);
}

/// HAPTIC, for one device or for two.
std::unique_ptr<runtime::Activity> SessionFrame::loop(runtime::GeometryActivity* geometry) {
  if (!world_.pair)
    return std::make_unique<runtime::HapticActivity>(
        bus_, devices_.device(), world_.tick, devices_.sensing(),
        options_.exact_geometry ? geometry : nullptr, world_.floors);
  using runtime::SensedTool;
  return std::make_unique<runtime::HapticPairActivity>(
      bus_,
      std::array<SensedTool, 2>{SensedTool{devices_.device(), devices_.sensing()},
                                SensedTool{devices_.second()->device, devices_.second()->sense()}},
      *world_.pair);
}

SessionRun SessionFrame::run(trial::TrialTask& task, trial::TrialScene& scene,
                             record::SessionInfo info, runtime::GeometryActivity* geometry) {
  const std::unique_ptr<runtime::Activity> haptic = loop(geometry);
  runtime::CameraActivity camera(
      bus_, timed(pictures_.exposer(devices_.bench(), executive_->clock()), world_.cost),
      pictures_.board(), pictures_.camera(), pictures_.settings(mode_, devices_.bench()),
      [this, look = pictures_.observer(devices_.bench())](const runtime::CameraView& view) {
        look(view);
        if (video_) video_->add(view);
      });
  SessionIgtl igtl(
      options_, world_.station,
      {world_.X_WA, unpack(world_.tick.X_ET),
       world_.tick.contact_mode == haptics::ContactMode::needle, world_.pair.has_value()},
      bus_, executive_->clock());
  if (info.uuid.empty()) info.uuid = newUuid();
  record::SessionWriter writer(folder_ / "session.palpa", info);
  const auto noted = noteForRecords(options_, info.uuid, folder_ / "session.palpa");
  if (options_.record_video) video_.emplace(folder_);
  std::optional<live::LiveSink> told;
  if (!options_.live.empty()) {
    live_ = std::make_unique<live::LiveSession>(
        options_.live, helloOf(options_, world_.station, info.uuid), channels_, bus_.stop);
    told.emplace(writer, live_->log(), world_.near, evidence::toneOfEvent);
  }
  runtime::RecorderActivity recorder(bus_, told ? static_cast<runtime::FlightSink&>(*told) : writer,
                                     world_.tick.period_ns);
  ProgressLine progress(options_.quiet);
  SessionWatch watch(*executive_, channels_, bus_.stop, devices_.driver(), live_.get());
  const WindowWatch window([&watch] { watch.windowIsLost(); });
  std::optional<StopKeyWatch> stop_key;
  if (stop_key_) stop_key.emplace(*stop_key_, bus_.stop);
  std::optional<PedalWatch> pedal;
  if (mode_ == runtime::TimeMode::real && !world_.station.stop_pedal.empty())
    pedal.emplace(world_.station.stop_pedal, bus_.stop);
  if (pedal) watch.listenTo([&pedal] { return pedal->news(); });
  devices_.addTo(*executive_);
  if (const std::string warning = devices_.warning(); !warning.empty()) task.warn(warning);
  if (window_ && !options_.fast) task.stay();
  if (window_) task.isMovedBy(trial::movedWords(heldBy(devices_), options_.left_handed));
  executive_->add(*haptic, {1, true, false, options_.cpu});
  if (geometry && !options_.exact_geometry) executive_->add(*geometry, {2, false, false});
  executive_->add(camera, {3, false, false});
  executive_->add(task, {4, false, false});
  executive_->add(scene, {5, false, true});
  executive_->add(recorder, {6, false, false});
  executive_->add(progress, {7, false, false});
  executive_->add(watch, {8, false, false});
  if (stop_key) executive_->add(*stop_key, {9, false, false});
  if (pedal) executive_->add(*pedal, {13, false, false});
  std::optional<Meanwhile> meanwhile;
  if (options_.meanwhile && mode_ == runtime::TimeMode::virtual_time)
    executive_->add(meanwhile.emplace(options_, channels_, bus_.stop), {10, false, false});
  if (sound_) executive_->add(*sound_, {11, false, false});
  const std::unique_ptr<runtime::RoomFilm> room =
      roomFilm(options_, world_.station, folder_, executive_->clock());
  if (room) {
    executive_->add(*room, {12, false, false});
    watch.listenTo([&room] { return room->news(); });
  }
  igtl.addTo(*executive_);
  executive_->whenStuck(
      [&](const runtime::Executive::Stuck& stuck, const std::string& failure) {
        if (!failure.empty()) sayTrouble(failure);
        sayTrouble(listed(stuck) + kLeftBehind);
        const bool is_kept = std::find(stuck.begin(), stuck.end(), recorder.name()) == stuck.end();
        if (const std::string trouble = is_kept ? keepEvidence(recorder, writer) : "";
            !trouble.empty())
          sayTrouble(trouble);
        leaveBehind(options_, folder_);
      },
      kEndPatience);
  try {
    runTimed(*executive_, world_.cost);
  } catch (...) {
    keepEvidence(recorder, writer);  // the fault that ended the session is told, and no other
    throw;
  }
  scene.finish(executive_->clock().now());
  recorder.finish();
  igtl.finish(executive_->clock().now());
  writer.close();
  if (live_ && !live_->end()) sayTrouble(partInWords("console") + kLeftBehind);
  live_.reset();
  if (place_) rememberWindow(*place_);
  SessionRun run = leftBy(task, scene);
  if (sound_) run.devices.push_back({"Sound as it was", sound_->facts(), ""});
  if (room)
    run.devices.push_back(
        {"Film of the room", counted(room->pictures(), "picture"), room->trouble()});
  for (report::Fact& fact : igtl.facts()) run.devices.push_back(std::move(fact));
  run.dropped = recorder.dropped() + task.lostTicks();
  return run;
}

SessionRun SessionFrame::leftBy(const trial::TrialTask& task, const trial::TrialScene& scene) {
  SessionRun run;
  run.pictures = scene.pictures();
  run.lateness = executive_->lateness();
  if (pictures_.fromBench()) run.accuracy = devices_.bench()->accuracy();
  if (video_) run.video = {video_->pictures(), video_->trouble()};
  run.registration = pictures_.registration();
  run.camera_remarks = pictures_.remarks();
  run.board = scene.board();
  run.devices = devices_.facts();
  if (window_ && !options_.headset) run.renderer = stage_.renderer;  // else few are drawn, or wait
  run.safety_events = task.safetyEvents();
  run.simulated_s = static_cast<double>(executive_->clock().now()) * 1e-9;
  run.quit = task.quit();
  return run;
}

}  // namespace palpa::session
