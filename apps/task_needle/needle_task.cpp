#include "apps/task_needle/needle_task.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "anatomy/geometry/error.h"
#include "apps/runtime/camera_words.h"

namespace palpa::task_needle {
namespace {

using runtime::kMillisecond;
using runtime::kSecond;
constexpr std::int64_t kTaskPeriod = 16'666'667;
constexpr std::int64_t kBetweenTrials = 3 * kSecond;   // the trainee takes the needle back
constexpr std::int64_t kReadyPatience = 15 * kSecond;
constexpr std::int64_t kTripShown = 2 * kSecond;
constexpr double kContactPause = 0.5;   // s without contact before the next one is news
constexpr double kFillRate = 0.25;                     // syringes a second through a freely bleeding needle

std::string scoresJson(const assess::TrialAssessment& a) {
  const assess::ParacentesisValues& v = a.values;
  return nlohmann::json{{"COL_LUNG", v.col_lung},   {"COL_RIB", v.col_rib},
                        {"COL_ART", v.col_art},     {"COL_VEIN", v.col_vein},
                        {"PHASE_1", v.phase_1},     {"PHASE_2", v.phase_2},
                        {"ECON_MEAN", v.econ_mean}, {"ECON_VAR", v.econ_var},
                        {"TIME", v.time_ms},        {"SUCCESS", v.success ? 1 : 0},
                        {"TOTAL", a.total}}
      .dump();
}

bool aspirating(const assess::TrialSample& sample, const assess::ScoringRules& rules) {
  return sample.tissue == Tissue::vein_lumen && sample.plunger >= rules.plunger_drawn;
}

}  // namespace

NeedleTask::NeedleTask(const Setup& setup, runtime::Bus& bus, TaskChannels& channels,
                       runtime::Executive& executive)
    : setup_(setup),
      bus_(bus),
      channels_(channels),
      executive_(executive),
      sampler_(setup.X_AD, setup.X_ET) {
  status_.trials = static_cast<int>(setup_.plan.size());
  completed_.reserve(setup_.plan.size());
}

std::int64_t NeedleTask::step(std::int64_t now_ns) {
  obey(now_ns);
  hearDevice();
  watchCamera(now_ns);
  listen(now_ns);
  switch (status_.state) {
    case TrialState::checking:
      checkReady(now_ns);
      break;
    case TrialState::waiting:
      if (setup_.automatic) startTrial(now_ns);
      break;
    case TrialState::ended:
      if (now_ns - since_ns_ >= kBetweenTrials) {
        if (status_.trial >= status_.trials) {
          status_.state = TrialState::finished;
          since_ns_ = now_ns;
        } else {
          status_.state = TrialState::checking;
          since_ns_ = now_ns;
        }
      }
      break;
    case TrialState::finished:
      if (now_ns - since_ns_ >= 200 * kMillisecond) executive_.stop();
      break;
    case TrialState::running:
    case TrialState::paused:
      break;
  }
  publish(now_ns);
  return now_ns + kTaskPeriod;
}

/// What is wrong with what the camera sees; of a board that is displaced the words stay the same while it moves on.
std::string NeedleTask::sightTrouble(const runtime::CameraView* view, std::int64_t now_ns) {
  const std::string trouble = runtime::cameraTrouble(view, now_ns);
  if (!trouble.empty()) {
    displaced_.reset();
    return trouble;
  }
  const auto was = displaced_ ? std::optional(displaced_->board) : std::nullopt;
  auto displaced = runtime::displacedBoard(*view, setup_.places, was);
  if (!displaced || was != displaced->board) displaced_ = std::move(displaced);
  return displaced_ ? displaced_->words : "";
}

/// The record marks when the camera or the board was lost, and when it was back.
void NeedleTask::watchCamera(std::int64_t now_ns) {
  const runtime::CameraView* view = bus_.camera_to_task.read(now_ns);
  if (!view) return;
  const std::string trouble = sightTrouble(view, now_ns);
  if (trouble == camera_) return;
  if (!trouble.empty()) tell(now_ns, "camera", trouble, 1);
  else tell(now_ns, "camera", "the camera sees the board", 0);
  camera_ = trouble;
}

void NeedleTask::checkReady(std::int64_t now_ns) {
  if (status_.emergency_stop) return;
  const runtime::CameraView* view = bus_.camera_to_task.read(now_ns);
  std::string missing;
  if (!last_.reading.homed) missing = status_.device.empty() ? "the haptic device is not homed" : status_.device;
  else if (last_.phase != haptics::NeedlePhase::outside || last_.depth > 0) missing = "the needle is in the skin: take it out";
  else if (const std::string trouble = sightTrouble(view, now_ns); !trouble.empty()) missing = trouble;
  status_.notice = missing.empty() ? "" : "Not ready: " + missing;
  if (missing.empty()) {
    tell(now_ns, "ready", setup_.calibration_problem.empty()
                              ? "Ready: device homed, board seen, calibration valid"
                              : "Ready, but not scored: " + setup_.calibration_problem);
    status_.state = TrialState::waiting;
    since_ns_ = now_ns;
    if (!setup_.automatic) status_.notice = "Press Enter to start";
  } else if (setup_.automatic && now_ns - since_ns_ > kReadyPatience) {
    throw Error(missing, "ready check", "Look at the station: device, camera, board");
  }
}

void NeedleTask::startTrial(std::int64_t now_ns) {
  ++status_.trial;
  status_.state = TrialState::running;
  status_.role = plan().role;
  status_.force_feedback = plan().force_feedback;
  status_.phase = assess::ProcedurePhase::approach;
  status_.elapsed_s = status_.blood = 0;
  status_.notice.clear();
  since_ns_ = now_ns;
  sampler_.begin(static_cast<std::uint32_t>(status_.trial));
  phases_ = {};
  samples_.clear();
  in_lumen_s_ = 0;
  touched_s_.fill(-kContactPause);
  entered_vein_ = false;
  bus_.task_to_recorder.push(runtime::TrialHeader{status_.trial, now_ns, plan().seed, plan().role,
                                                  plan().force_feedback, plan().puncture_force_N});
  tell(now_ns, "start", "Trial " + std::to_string(status_.trial) + " starts");
  picture("start", "Before the needle touches the skin");
}

void NeedleTask::endTrial(const std::string& outcome, const std::string& reason,
                          std::int64_t now_ns) {
  CompletedTrial trial;
  trial.reason = reason;
  assess::TrialFacts facts{status_.trial, plan().role, setup_.simulated, plan().force_feedback,
                           plan().seed, outcome};
  if (setup_.expert_path) {
    trial.assessment = assess::assessTrial(facts, samples_, setup_.patient, setup_.query,
                                           *setup_.expert_path, setup_.settings.rules);
  } else {
    trial.assessment.trial = status_.trial;
    trial.assessment.role = plan().role;
    trial.assessment.outcome = outcome;
    trial.assessment.seed = plan().seed;
    trial.assessment.simulated = setup_.simulated;
    trial.assessment.values.success = outcome == "success";
  }
  trial.samples = std::move(samples_);
  samples_.clear();
  tell(now_ns, outcome, reason.empty() ? trial.assessment.summary : reason);
  bus_.task_to_recorder.push(
      runtime::TrialEnd{status_.trial, last_.t_ns, outcome, reason,
                        outcome == "void" ? "" : scoresJson(trial.assessment)});
  picture("end", outcome == "success" ? "Blood flows freely: the vein is reached" : "The end of the trial");
  completed_.push_back(std::move(trial));
  status_.state = TrialState::ended;
  status_.blood_flows = false;
  status_.notice = outcome == "success" ? "Vein reached. Trial ended" : "Trial ended: " + outcome;
  since_ns_ = now_ns;
}

void NeedleTask::listen(std::int64_t now_ns) {
  haptics::FlightRecord record;
  while (bus_.haptic_to_task.pop(&record)) judge(record, now_ns);
}

/// Trips and what limits the force become events, and stay on the screen long enough to be read. A device that has lost
/// its position pauses the trial: force comes back when somebody asks for it.
void NeedleTask::watchSafety(const haptics::FlightRecord& record) {
  using haptics::SafetyCause;
  if (record.events & haptics::kSafetyTripped) {
    tell(record.t_ns, "safety", std::string("Force taken away: ") + haptics::name(record.safety));
    status_.trip = record.safety;
    trip_ns_ = record.t_ns;
  }
  if (record.events & haptics::kSafetyCleared) tell(record.t_ns, "safety", "Force is back");
  if (record.events & haptics::kSnapshotRefused) tell(record.t_ns, "safety", "Damaged geometry was refused");
  if (record.t_ns - trip_ns_ > kTripShown) status_.trip = SafetyCause::none;
  if (record.safety == SafetyCause::duty) {
    if (warm_ns_ < 0 || record.t_ns - warm_ns_ > kTripShown)
      tell(record.t_ns, "safety", "The drives are warm: forces are reduced");
    warm_ns_ = record.t_ns;
  }
  if (status_.state == TrialState::running && last_.reading.homed && !record.reading.homed) {
    status_.state = TrialState::paused;
    status_.notice = "Paused: the device has lost its position. When it is back, Enter goes on";
    tell(record.t_ns, "pause", "The trial is paused: the device has lost its position");
  }
}

/// What a driver has to say stays on the screen until it is over.
void NeedleTask::hearDevice() {
  runtime::Event event;
  while (bus_.device_to_task.pop(&event)) {
    status_.device = event.text;
    tell(event.t_ns, event.kind, event.text.empty() ? "The haptic device is ready" : event.text);
  }
}

void NeedleTask::judge(const haptics::FlightRecord& record, std::int64_t now_ns) {
  watchSafety(record);
  last_ = record;
  if (status_.state != TrialState::running && status_.state != TrialState::paused) return;
  assess::TrialSample sample;
  if (!sampler_.add(record, &sample)) return;
  const double dt = samples_.empty() ? 0 : sample.t_s - samples_.back().t_s;
  samples_.push_back(sample);
  phases_.add(sample);
  announce(sample, record.t_ns);
  status_.elapsed_s = sample.t_s;
  status_.plunger = sample.plunger;
  status_.blood_flows = aspirating(sample, setup_.settings.rules);
  in_lumen_s_ = status_.blood_flows ? in_lumen_s_ + dt : 0;
  if (status_.blood_flows)
    status_.blood = std::min(sample.plunger, status_.blood + kFillRate * dt);
  if (in_lumen_s_ >= setup_.settings.rules.dwell_s) return endTrial("success", "", now_ns);
  if (sample.t_s >= setup_.settings.time_limit_s) return endTrial("time", "The time limit was reached", now_ns);
}

/// Events in clinical words, and pictures of the moments that the report shows.
void NeedleTask::announce(const assess::TrialSample& sample, std::int64_t now_ns) {
  if (phases_.phase() != status_.phase) {
    status_.phase = phases_.phase();
    tell(now_ns, "phase", assess::clinicalName(status_.phase));
    if (status_.phase == assess::ProcedurePhase::advance)
      picture("phase-2", "Phase 2 begins: the needle is directed behind the clavicle");
  }
  if (sample.events & haptics::kSkinPunctured) {
    tell(now_ns, "puncture", "The skin is punctured");
    picture("puncture", "The skin is punctured");
  }
  if (sample.events & haptics::kWithdrawn) tell(now_ns, "withdrawn", "The needle is out of the skin");
  if (sample.events & haptics::kWallPunctured && sample.wall != Organ::none)
    tell(now_ns, "wall", std::string("Wall punctured: ") + palpa::name(sample.wall));
  Organ touching = sample.bone;
  if (sample.tissue == Tissue::lung || sample.wall == Organ::lung) touching = Organ::lung;
  if (sample.tissue == Tissue::artery_lumen || sample.wall == Organ::artery) touching = Organ::artery;
  if (sample.tissue == Tissue::vein_lumen && !entered_vein_) {
    entered_vein_ = true;
    tell(now_ns, "vein", "The tip is in the vein");
    picture("vein", "The tip enters the vein");
  }
  if (touching == Organ::none) return;
  double& last_s = touched_s_[static_cast<std::size_t>(touching)];
  const bool again = sample.t_s - last_s < kContactPause;  // the same contact, trembling
  last_s = sample.t_s;
  if (again) return;
  tell(now_ns, "touched", std::string("Touched: ") + palpa::name(touching));
  if (touching == Organ::lung || touching == Organ::artery || (isBone(touching) && touching != Organ::clavicle))
    picture(palpa::name(touching), std::string("Error: the needle touches the ") + palpa::name(touching));
}

void NeedleTask::obey(std::int64_t now_ns) {
  UserRequest request;
  while (channels_.requests_to_task.pop(&request) || channels_.operator_to_task.pop(&request) ||
         channels_.signals_to_task.pop(&request))
    obey(request, now_ns);
}

void NeedleTask::obey(const UserRequest& request, std::int64_t now_ns) {
  const bool in_trial = status_.state == TrialState::running || status_.state == TrialState::paused;
  switch (request.command) {
    case UserCommand::start:
      if (status_.emergency_stop) return;  // only re-arming goes on from here
      if (status_.state == TrialState::waiting) startTrial(now_ns);
      else if (status_.state == TrialState::paused) {
        status_.state = TrialState::running;
        status_.notice.clear();
        tell(now_ns, "resume", "The trial goes on");
      }
      return;
    case UserCommand::pause:
      if (status_.state != TrialState::running) return;
      status_.state = TrialState::paused;
      status_.notice = "Paused: Enter goes on";
      return tell(now_ns, "pause", "The trial is paused");
    case UserCommand::abort:
      if (in_trial) endTrial("aborted", request.reason.empty() ? "Aborted by the person in charge" : request.reason, now_ns);
      return;
    case UserCommand::void_trial:
      if (in_trial) endTrial("void", request.reason, now_ns);
      return;
    case UserCommand::emergency_stop:
      status_.emergency_stop = true;
      status_.alarm = true;
      status_.notice = "EMERGENCY STOP: forces are off. R re-arms, then Enter goes on";
      if (status_.state == TrialState::running) status_.state = TrialState::paused;
      return tell(now_ns, "emergency_stop", "Emergency stop");
    case UserCommand::rearm:
      status_.emergency_stop = status_.alarm = false;
      if (status_.state == TrialState::running) status_.state = TrialState::paused;  // disarms: clears a trip
      status_.notice = status_.state == TrialState::paused || status_.state == TrialState::waiting
                           ? "Re-armed: Enter goes on" : "";
      return tell(now_ns, "rearm", "Re-armed");
    case UserCommand::quit:
      if (in_trial) endTrial("aborted", request.reason.empty() ? "The session was closed" : request.reason, now_ns);
      quit_ = true;
      executive_.stop();
      return;
  }
}

void NeedleTask::tell(std::int64_t now_ns, const std::string& kind, const std::string& text,
                      double value) {
  const runtime::Event event{now_ns, status_.trial, kind, text, value};
  if (kind == "safety" || kind == "device" || (kind == "camera" && value > 0)) safety_events_.push_back(event);
  bus_.task_to_recorder.push(event);
}

void NeedleTask::picture(const std::string& label, const std::string& caption) {
  channels_.pictures_to_scene.push({status_.trial, status_.elapsed_s, label, caption});
}

void NeedleTask::publish(std::int64_t now_ns) {
  haptics::TickCommands commands;
  commands.trial = static_cast<std::uint32_t>(status_.trial);
  commands.armed = status_.state == TrialState::running;
  commands.emergency_stop = status_.emergency_stop;
  if (status_.trial > 0) {
    commands.force_feedback = plan().force_feedback;
    commands.puncture_force_N = plan().puncture_force_N;
    commands.wall_scale = plan().wall_scale;
    commands.subtask = static_cast<std::uint8_t>(status_.phase);
  }
  bus_.task_to_haptic.publish(commands, now_ns);
  channels_.status_to_scene.publish(status_, now_ns);
}

}  // namespace palpa::task_needle
