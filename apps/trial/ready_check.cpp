#include "anatomy/base/error.h"
#include "apps/trial/trial_task.h"

/// What a task has to see before a trial can begin, and of the camera while one runs.
namespace palpa::trial {

using runtime::EventKind;

namespace {

// A simulated person moves while there is a picture to see: on a computer that hardly draws he is
// given as many as these seconds show at 30 a second, but not for ever.
constexpr std::int64_t kReadyPatience = 15 * runtime::kSecond,
                       kLongestPatience = 8 * kReadyPatience;
constexpr std::uint64_t kReadyPictures = 450;

}  // namespace

/// What is wrong with what the camera sees; of a board that is displaced the words stay the same
/// while it moves on.
std::string TrialTask::sightTrouble(const runtime::CameraView* view, std::int64_t now_ns) {
  std::string trouble = runtime::cameraTrouble(view, now_ns);
  if (!trouble.empty()) {
    displaced_.reset();
    return trouble;
  }
  const auto was = displaced_ ? std::optional(displaced_->board) : std::nullopt;
  auto displaced = runtime::displacedBoard(*view, lead_.places, was);
  if (!displaced || was != displaced->board) displaced_ = std::move(displaced);
  return displaced_ ? displaced_->words : "";
}

/// The record marks when the camera or the board was lost, and when it was back.
void TrialTask::watchCamera(std::int64_t now_ns) {
  const runtime::CameraView* view = bus_.camera_to_task.read(now_ns);
  if (!view) return;
  const std::string trouble = sightTrouble(view, now_ns);
  if (trouble == camera_) return;
  if (!trouble.empty())
    report(now_ns, EventKind::camera, trouble, 1);
  else
    report(now_ns, EventKind::camera,
           view->by_tracker ? "the tracking system sees the camera" : "the camera sees the board",
           0);
  camera_ = trouble;
}

/// Why no trial can begin; empty: everything is there.
std::string TrialTask::missing(std::int64_t now_ns) {
  if (!last_.reading.homed)
    return status_.device.empty() ? "the haptic device is not homed" : status_.device;
  if (std::string tool = notReady(last_); !tool.empty()) return tool;
  return sightTrouble(bus_.camera_to_task.read(now_ns), now_ns);
}

/// Whether the ready check has lasted longer than anything that somebody could still put right.
bool TrialTask::isTooLong(std::int64_t now_ns) {
  const std::uint64_t pictures = channels_.frames.load(std::memory_order_relaxed);
  if (check_since_ns_ != since_ns_) {
    check_since_ns_ = since_ns_;
    check_pictures_ = pictures;
  }
  const std::int64_t lasted = now_ns - since_ns_;
  return lasted > kLongestPatience ||
         (lasted > kReadyPatience && pictures - check_pictures_ >= kReadyPictures);
}

/// Before the first trial the computer is tried as well, for the two seconds that it takes to see
/// whether it keeps up.
void TrialTask::checkReady(std::int64_t now_ns) {
  if (status_.emergency_stop) return;
  const std::string words = missing(now_ns);
  status_.notice = words.empty() ? "" : "Not ready: " + words;
  if (!words.empty() && lead_.automatic && isTooLong(now_ns)) {
    report(
        now_ns, EventKind::computer,
        (status_.trial > 0 ? "No further trial could begin: " : "No trial could begin: ") + words,
        1);
    throw Error(words, "ready check", "Look at the station: device, camera, board");
  }
  if (!words.empty()) return;
  if (real_time_ && status_.trial == 0 && !load_.rehearsed())
    status_.notice = "Checking this computer, 2 s";
  else
    becomeReady(now_ns);
}

void TrialTask::becomeReady(std::int64_t now_ns) {
  report(now_ns, EventKind::ready,
         lead_.calibration_problem.empty() ? "Ready: device homed, board seen, calibration valid"
                                           : "Ready, but not scored: " + lead_.calibration_problem);
  const std::string warning = status_.trial == 0 ? sayWarnings(now_ns) : "";
  status_.state = TrialState::waiting;
  since_ns_ = now_ns;
  if (lead_.automatic) return;
  status_.notice = warning.empty() ? "Press Enter to start. ? shows keys"
                                   : warning + ". Enter starts, ? shows keys";
  if (above_.empty()) return;
  status_.notice = above_ + '\n' +
                   (warning.empty() ? "Enter starts, ? shows keys" : std::string(status_.notice));
}

/// All for the evidence, the first for the notice; none forbids a trial.
std::string TrialTask::sayWarnings(std::int64_t now_ns) {
  std::string first;
  const auto say = [&](const std::string& words) {
    if (first.empty()) first = words;
  };
  for (const std::string& words : warnings_) {
    report(now_ns, EventKind::device, words);
    say(words);
  }
  if (!real_time_) return first;
  for (const LoadWatch::Verdict& verdict : load_.verdicts()) {
    const std::string words = verdict.what + ": " + verdict.remedy;
    report(now_ns, EventKind::computer, words + "; palpa doctor tells more", 1);
    say(words);
  }
  return first;
}

}  // namespace palpa::trial
