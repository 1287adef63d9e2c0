#include "apps/trial/trial_task.h"

#include <algorithm>

#include "apps/trial/trial_scene.h"

namespace palpa::trial {

using runtime::EventKind;
using training::Outcome;

namespace {

using runtime::kMillisecond;
using runtime::kSecond;
constexpr std::int64_t kTaskPeriod = 16'666'667;
constexpr std::int64_t kBetweenTrials = 3 * kSecond,  // the trainee takes the tool back
    kReading = 60 * kSecond;
constexpr std::int64_t kTripShown = 2 * kSecond;

}  // namespace

TrialTask::TrialTask(const Lead& lead, runtime::Bus& bus, Channels& channels,
                     runtime::Executive& executive)
    : lead_(lead),
      bus_(bus),
      channels_(channels),
      executive_(executive),
      real_time_(executive.mode() == runtime::TimeMode::real) {
  status_.trials = lead.trials;
}

std::int64_t TrialTask::step(std::int64_t now_ns) {
  now_ns_ = now_ns;
  apply(now_ns);
  watchStop(now_ns);
  receiveDevice();
  watchCamera(now_ns);
  listen(now_ns);
  switch (status_.state) {
    case TrialState::checking:
      checkReady(now_ns);
      break;
    case TrialState::waiting:
      if (lead_.automatic) startTrial(now_ns);
      break;
    case TrialState::ended:
      comeToAnEnd(now_ns);
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

/// After the last trial a person who reads how it ended says when that is done.
void TrialTask::comeToAnEnd(std::int64_t now_ns) {
  const bool last = status_.trial >= status_.trials;
  if (now_ns - since_ns_ < (last && stays_ ? kReading : kBetweenTrials)) return;
  status_.state = last ? TrialState::finished : TrialState::checking;
  since_ns_ = now_ns;
}

/// What a trial suffered from the computer, how often as the events' values. In virtual time
/// nothing is late.
void TrialTask::reportLoad(std::int64_t now_ns) {
  if (!real_time_) return;
  load_.look(LoadWatch::seenOn(bus_, channels_.frames.load(std::memory_order_relaxed)));
  if (const auto missed = static_cast<double>(load_.missed()); missed > 0)
    report(now_ns, EventKind::computer, "The computer missed ticks of the haptic loop in a trial",
           missed);
  if (const auto lost = static_cast<double>(load_.lost()); lost > 0)
    report(now_ns, EventKind::computer,
           "The computer lost records of a trial: its replay is not exact", lost);
}

void TrialTask::startTrial(std::int64_t now_ns) {
  asked_to_leave_ns_ = -1;
  ++status_.trial;
  status_.state = TrialState::running;
  status_.elapsed_s = 0;
  status_.notice.clear();
  since_ns_ = now_ns;
  load_.beginTrial();
  const runtime::TrialHeader header = begin(now_ns);
  start_ns_ = header.t_ns;
  status_.role = training::roleNamed(header.role);
  status_.force_feedback = header.force_feedback;
  bus_.task_to_recorder.push(header);
  report(now_ns, EventKind::start, "Trial " + std::to_string(status_.trial) + " starts");
}

/// It ends with the last tick that was judged; one that was ended before its first, as it began.
void TrialTask::endTrial(Outcome outcome, const std::string& reason, std::int64_t now_ns) {
  asked_to_leave_ns_ = -1;
  reportLoad(now_ns);
  const Conclusion end = conclude(outcome, reason);
  const std::string& name = training::nameOf(outcome);
  note({now_ns, status_.trial, name, reason.empty() ? end.sentence : reason, 0});
  picture("end", end.caption);
  bus_.task_to_recorder.push(runtime::TrialEnd{status_.trial, std::max(last_.t_ns, start_ns_), name,
                                               reason,
                                               outcome == Outcome::voided ? "" : end.scores_json});
  status_.state = TrialState::ended;
  status_.notice = above_ = endNotice(status_.role, outcome, end.result, reason);
  since_ns_ = now_ns;
}

void TrialTask::hold(const std::string& trouble, std::int64_t now_ns) {
  report(now_ns, EventKind::safety, "Force taken away: " + trouble);
  if (lead_.automatic) return endTrial(Outcome::voided, trouble, now_ns);
  status_.state = TrialState::paused;
  status_.notice = "Paused: " + trouble + ". Then Enter continues";
  report(now_ns, EventKind::pause, "The trial is paused: " + trouble);
}

void TrialTask::listen(std::int64_t now_ns) {
  haptics::FlightRecord record;
  const auto hear = [&](const haptics::FlightRecord& heard) {
    watchSafety(heard);
    last_ = heard;
    if (real_time_) load_.tick(heard);
    watch(heard);
    if (status_.active()) judge(heard, now_ns);
  };
  while (bus_.haptic_to_task.pop(&record)) {
    if (lead_.tools == 2 &&
        record.tool == 0) {  // with the second one's: a trial ends between ticks
      first_ = record;
      continue;
    }
    if (lead_.tools == 2) hear(first_);
    hear(record);
  }
  if (real_time_)
    load_.look(LoadWatch::seenOn(bus_, channels_.frames.load(std::memory_order_relaxed)));
}

/// Trips and what limits the force become events, and stay on the screen long enough to be read. A
/// device that has lost its position pauses the trial: force comes back when somebody asks for it.
void TrialTask::watchSafety(const haptics::FlightRecord& record) {
  using haptics::SafetyCause;
  const bool by_the_end = record.safety == SafetyCause::emergency_stop && bus_.stop.ended();
  if ((record.events & haptics::kSafetyTripped) && !by_the_end) {
    report(record.t_ns, EventKind::safety, "Force taken away: " + whyText(record.safety));
    status_.trip = record.safety;
    trip_ns_ = record.t_ns;
  }
  if (record.events & haptics::kSafetyCleared)
    report(record.t_ns, EventKind::safety, runtime::kForceIsBack);
  if (record.events & haptics::kSnapshotRefused)
    report(record.t_ns, EventKind::safety, "Damaged geometry was refused");
  if (record.t_ns - trip_ns_ > kTripShown) status_.trip = SafetyCause::none;
  if (record.safety == SafetyCause::duty) {
    if (warm_ns_ < 0 || record.t_ns - warm_ns_ > kTripShown)
      report(record.t_ns, EventKind::safety, "The drives are warm: forces are reduced");
    warm_ns_ = record.t_ns;
  }
  if (status_.state == TrialState::running && last_.reading.homed && !record.reading.homed) {
    status_.state = TrialState::paused;
    status_.notice = "Paused: the device has lost its position. When it is back, Enter continues";
    report(record.t_ns, EventKind::pause, "The trial is paused: the device has lost its position");
  }
}

/// What a driver has to say stays on the screen until it is over.
void TrialTask::receiveDevice() {
  runtime::Event event;
  while (bus_.device_to_task.pop(&event)) {
    status_.device = event.text;
    event.trial = status_.trial;
    if (event.text.empty()) event.text = "The haptic device is ready";
    note(event);
  }
}

void TrialTask::apply(std::int64_t now_ns) {
  UserRequest request;
  while (channels_.requests_to_task.pop(&request) || channels_.operator_to_task.pop(&request) ||
         channels_.signals_to_task.pop(&request) || channels_.console_to_task.pop(&request))
    apply(request, now_ns);
}

void TrialTask::apply(const UserRequest& request, std::int64_t now_ns) {
  const std::string& reason = request.reason;
  switch (request.command) {
    case UserCommand::start:
      return goOn(now_ns);
    case UserCommand::pause:
      if (status_.state != TrialState::running) return;
      status_.state = TrialState::paused;
      status_.notice = "Paused: Enter continues";
      return report(now_ns, EventKind::pause, "The trial is paused");
    case UserCommand::abort:
      if (isMeant(request, now_ns))
        endTrial(Outcome::aborted, reason.empty() ? "Aborted by the person in charge" : reason,
                 now_ns);
      return;
    case UserCommand::void_trial:
      if (isMeant(request, now_ns)) endTrial(Outcome::voided, reason, now_ns);
      return;
    case UserCommand::emergency_stop:
      return bus_.stop.press();
    case UserCommand::rearm:
      return rearm(now_ns);
    case UserCommand::escape:
      return escape(now_ns);
    case UserCommand::quit:
      leave(reason, now_ns);
      quit_ = true;
      executive_.stop();
      return;
    case UserCommand::note:
      return report(now_ns, EventKind::note, reason, request.at_s);
    case UserCommand::remark:
      return report(now_ns, EventKind::computer, reason, request.at_s);
    case UserCommand::done:
    case UserCommand::grade:
    case UserCommand::choose:
      if (status_.active()) receive(request, now_ns);
      return;
  }
}

/// The trial that is on; while somebody made up his mind it may have become another.
bool TrialTask::isMeant(const UserRequest& request, std::int64_t now_ns) {
  if (request.trial > 0 && !(status_.active() && request.trial == status_.trial)) {
    const std::string which = "Trial " + std::to_string(request.trial);
    report(now_ns, EventKind::note,
           which + " had ended when it was to be ended by hand: nothing was changed. " +
               request.reason);
    return false;
  }
  return status_.active();
}

/// A slip of the finger costs no trial: one that is on is paused, and ends when it is asked for
/// again, a second later at least (a key that is held repeats itself).
void TrialTask::escape(std::int64_t now_ns) {
  const bool asked = asked_to_leave_ns_ >= 0;
  if (asked && now_ns - asked_to_leave_ns_ < runtime::kSecond) return;
  if (!status_.active() || asked) return apply(UserRequest{UserCommand::quit, ""}, now_ns);
  const std::string before =
      status_.state == TrialState::running ? "Enter continues" : status_.notice;
  apply(UserRequest{UserCommand::pause, ""}, now_ns);
  asked_to_leave_ns_ = now_ns;
  status_.notice = std::string("Escape again ends the session: this trial ") +
                   (training::inAssessment(status_.role) ? "counts as aborted" : "does not count") +
                   ". " + before;
}

/// In practice nobody's failure; from an examination one does not slip away.
void TrialTask::leave(const std::string& reason, std::int64_t now_ns) {
  if (!status_.active()) return;
  endTrial(training::inAssessment(status_.role) ? Outcome::aborted : Outcome::voided,
           reason.empty() ? "The session was closed" : reason, now_ns);
}

void TrialTask::goOn(std::int64_t now_ns) {
  asked_to_leave_ns_ = -1;
  if (status_.state == TrialState::ended && stays_ && status_.trial >= status_.trials)
    since_ns_ = now_ns - kReading;
  if (status_.emergency_stop) return;  // only re-arming goes on from here
  if (status_.state == TrialState::waiting) return startTrial(now_ns);
  if (status_.state != TrialState::paused) return;
  status_.state = TrialState::running;
  status_.notice.clear();
  report(now_ns, EventKind::resume, "The trial continues");
}

/// The force is gone since the tick after the press; here the trial learns of it.
void TrialTask::watchStop(std::int64_t now_ns) {
  const std::uint32_t presses = bus_.stop.presses();
  if (presses == presses_seen_) return;
  presses_seen_ = presses;
  stopAll(now_ns);
}

void TrialTask::stopAll(std::int64_t now_ns) {
  if (status_.emergency_stop) return;  // a key that is held presses many times
  status_.emergency_stop = true;
  status_.alarm = true;
  status_.notice = "EMERGENCY STOP: forces are off. [R] re-arms, then Enter continues";
  if (status_.state == TrialState::running) status_.state = TrialState::paused;
  report(now_ns, EventKind::emergency_stop, "Emergency stop");
}

void TrialTask::rearm(std::int64_t now_ns) {
  asked_to_leave_ns_ = -1;
  bus_.stop.rearm(presses_seen_);
  status_.emergency_stop = status_.alarm = false;
  if (status_.state == TrialState::running)
    status_.state = TrialState::paused;  // disarms: clears a trip
  status_.notice = status_.state == TrialState::paused || status_.state == TrialState::waiting
                       ? "Re-armed: Enter continues"
                       : "";
  report(now_ns, EventKind::rearm, "Re-armed");
}

void TrialTask::report(std::int64_t now_ns, EventKind kind, const std::string& text, double value) {
  note({now_ns, status_.trial, nameOf(kind), text, value});
}

bool isForTheReport(const runtime::Event& event) {
  return event.is(EventKind::safety) || event.is(EventKind::device) ||
         (event.value > 0 && (event.is(EventKind::camera) || event.is(EventKind::computer)));
}

void TrialTask::note(const runtime::Event& event) {
  if (isForTheReport(event)) safety_events_.push_back(event);
  bus_.task_to_recorder.push(event);
}

void TrialTask::picture(const std::string& label, const std::string& caption) {
  const PictureRequest request{status_.trial, status_.elapsed_s, label, caption, ++pictures_};
  report(now_ns_, EventKind::picture, pictureText(request), request.t_s);
  channels_.pictures_to_scene.push(request);
}

/// Where a notice stands it says so itself, and this is not shown.
std::string TrialTask::canDo() const {
  if (lead_.automatic) return "";
  if (status_.state == TrialState::ended)
    return stays_ && status_.trial >= status_.trials ? "Enter closes" : "";
  if (status_.state == TrialState::paused)
    return "Enter continues, [A] ends the trial, ? shows keys";
  if (status_.state != TrialState::running) return "? shows keys";
  const std::string own = doing();
  if (!own.empty()) return own + ". ? shows keys";
  return moved_.empty() ? "[P] pauses, ? shows keys" : moved_ + ". ? shows keys";
}

void TrialTask::publish(std::int64_t now_ns) {
  status_.can_do = canDo();
  haptics::TickCommands commands;
  commands.trial = static_cast<std::uint32_t>(status_.trial);
  commands.armed = status_.state == TrialState::running;
  if (status_.trial > 0) {
    commands.force_feedback = status_.force_feedback;
    command(commands);
  }
  bus_.task_to_haptic.publish(commands, now_ns);
  publishStatus(now_ns);
}

}  // namespace palpa::trial
