#include "apps/task_pulse/pulse_task.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace palpa::task_pulse {

using assess::PulseRhythm;
using runtime::EventKind;
using training::Outcome;

namespace {

constexpr std::int64_t kFirstBeat_ns = 500'000'000;  // after the trial's start
constexpr std::size_t kMostDigits = 3;
constexpr int kRhythmCount = 3;

bool isNumber(const std::string& text) {
  return !text.empty() && text.size() <= kMostDigits &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

PulsePart partIn(const haptics::TickCommands& commands) {
  return static_cast<PulsePart>(
      std::min(commands.subtask, static_cast<std::uint8_t>(PulsePart::rhythm)));
}

PulseListener::PulseListener(const haptics::TickConfig& config, const assess::PulseRules& rules)
    : X_PD_(unpack(config.X_DP).inverse()),
      X_ET_(unpack(config.X_ET)),
      radius_(config.touch.tip_radius),
      closed_at_(config.pulse.closed_at),
      rules_(rules) {}

void PulseListener::begin(std::uint32_t trial) {
  trial_ = trial;
  clock_ = {};
  last_ns_ = -1;
  pressed_ = true;
  counted_s_ = shut_s_ = off_s_ = peak_N_ = now_N_ = mark_s_ = 0;
  marks_ = delivered_ = 0;
  mark_P_.reset();
}

void PulseListener::add(const haptics::FlightRecord& record) {
  if (record.commands.trial != trial_) return;
  if (!record.commands.armed || !record.reading.homed) {
    clock_.pause();
    pressed_ = true;  // what is pressed over a pause marks nothing
    return;
  }
  const std::int64_t before_ns = last_ns_;
  last_ns_ = record.t_ns;
  const double dt = clock_.pass(record.t_ns);
  const Vec3 f_D = unpack(record.sensed.f_D) + unpack(record.f_command_D);
  now_N_ = std::max((X_PD_.linear() * f_D).z(), 0.0);
  peak_N_ = std::max(peak_N_, now_N_);
  const PulsePart part = partIn(record.commands);
  watchMark(record, part);
  if (dt <= 0) return;
  if (part == PulsePart::count) countBeats(record, before_ns, dt);
}

void PulseListener::watchMark(const haptics::FlightRecord& record, PulsePart part) {
  const bool down = (record.reading.buttons & kMark) != 0;
  if (down && !pressed_ && part == PulsePart::find && touching()) {
    const Pose X_DE = makePose(unpack(record.reading.q_DE).normalized().toRotationMatrix(),
                               unpack(record.reading.p_DE));
    mark_P_ = X_PD_ * (X_DE * (X_ET_ * Vec3(0, 0, -radius_))) - radius_ * Vec3::UnitZ();
    mark_s_ = seconds();
    ++marks_;
  }
  pressed_ = down;
}

void PulseListener::countBeats(const haptics::FlightRecord& record, std::int64_t since_ns,
                               double dt) {
  counted_s_ += dt;
  const haptics::PulsingArtery& artery = record.commands.artery;
  for (const haptics::PulseBeat& beat : artery.beats)
    delivered_ += beat.strength > 0 && beat.start_ns > since_ns && beat.start_ns <= record.t_ns;
  const double real_N = record.skin_force;
  if (real_N > closed_at_ * artery.best_N) shut_s_ += dt;
  if (now_N_ < rules_.touch_N) off_s_ += dt;
}

void PulseListener::into(const PulseCase& patient, assess::PulseTrial* trial) const {
  trial->seconds = seconds();
  trial->peak_N = peak_N_;
  if (mark_P_) {
    trial->off_m = besideArtery(patient.artery, *mark_P_);
    trial->found_s = mark_s_;
  }
  if (!(counted_s_ >= rules_.count_s)) return;
  trial->delivered = delivered_;
  trial->shut_pct = 100 * shut_s_ / counted_s_;
  trial->off_line_pct = 100 * off_s_ / counted_s_;
}

void PulseAnswer::add(double value) {
  const int number = static_cast<int>(std::lround(std::clamp(value, 0.0, 1000.0)));
  if (!counted)
    counted = number;
  else if (number >= 1 && number <= kRhythmCount)
    rhythm = static_cast<PulseRhythm>(number - 1);
}

assess::PulseTrial judged(assess::PulseTrial facts, const PulseCase& patient,
                          const PulseListener& listener, const PulseAnswer& said) {
  facts.artery = patient.name;
  facts.depth_m = patient.artery.depth;
  facts.rhythm = patient.rhythm;
  facts.counted = said.counted;
  facts.said = said.rhythm;
  listener.into(patient, &facts);
  return facts;
}

std::string scoreJson(const assess::PulseTrial& trial, const assess::PulseRules& rules) {
  nlohmann::json score{{"RIGHT", trial.right(rules) ? 1 : 0},
                       {"FOUND", trial.found(rules) ? 1 : 0},
                       {"RHYTHM_TOLD", trial.told() ? 1 : 0},
                       {"PEAK_N", trial.peak_N},
                       {"TIME_S", trial.seconds}};
  if (trial.off_m) score["OFF_MM"] = 1e3 * *trial.off_m;
  if (trial.delivered) score["DELIVERED"] = *trial.delivered;
  if (trial.counted) score["COUNTED"] = *trial.counted;
  if (const std::optional<double> error = trial.countError(rules)) score["ERROR_PER_MIN"] = *error;
  return score.dump();
}

PulseTask::PulseTask(const PulseTaskSetup& setup, runtime::Bus& bus, PulseChannels& channels,
                     runtime::Executive& executive)
    : TrialTask(
          {static_cast<int>(setup.cases.size()), setup.automatic, setup.not_scored, setup.places},
          bus, channels, executive),
      setup_(setup),
      channels_(channels),
      listener_(setup.tick, setup.settings.rules) {
  completed_.reserve(setup.cases.size());
}

std::string PulseTask::notReady(const haptics::FlightRecord& last) const {
  if (!last.reading.homed) return "the device is not homed";
  if (last.sensed.state != haptics::SensorState::valid)
    return "the force sensor gives no reading that can be used";
  if (unpack(last.sensed.f_D).norm() >= setup_.settings.rules.touch_N)
    return "the tool touches something: lift it";
  return "";
}

runtime::TrialHeader PulseTask::begin(std::int64_t now_ns) {
  part_ = PulsePart::find;
  typed_.clear();
  said_ = {};
  listener_.begin(static_cast<std::uint32_t>(status().trial));
  heart_.emplace(
      Heart(setup_.settings.heart, patient().rhythm, patient().rate_per_min, patient().heart_seed),
      now_ns + kFirstBeat_ns);
  beats_ = heart_->at(now_ns);
  const training::Role role = setup_.not_scored.empty() ? setup_.role : training::Role::not_scored;
  report(now_ns, EventKind::trial_case, caseText(patient()));
  picture("start", "Before anything was felt");
  return {status().trial, now_ns, setup_.seed, training::nameOf(role), setup_.force_feedback, 0};
}

trial::TrialTask::Conclusion PulseTask::conclude(Outcome outcome, const std::string& reason) {
  assess::PulseTrial facts;
  facts.trial = status().trial;
  facts.role = status().role;
  facts.simulated = setup_.simulated;
  facts.force_feedback = setup_.force_feedback;
  facts.seed = setup_.seed;
  facts.outcome = outcome;
  part_ = PulsePart::none;
  completed_.push_back({judged(facts, patient(), listener_, said_), reason});
  const assess::PulseTrial& trial = completed_.back().trial;
  const std::string summary = summaryOf(trial, setup_.settings.rules);
  return {scoreJson(trial, setup_.settings.rules), summary, summary, "After the answer"};
}

void PulseTask::judge(const haptics::FlightRecord& record, std::int64_t now_ns) {
  const int marks = listener_.marks();
  listener_.add(record);
  beats_ = heart_->at(record.t_ns);
  if (listener_.marks() > marks) {
    report(record.t_ns, EventKind::mark, "The examiner marks a place: the pulse is felt here");
    picture("mark", "Marked: the pulse is felt here");
  }
  status().elapsed_s = listener_.seconds();
  if (part_ == PulsePart::count && listener_.countedSeconds() >= setup_.settings.rules.count_s) {
    part_ = PulsePart::number;
    status().notice.clear();
    report(now_ns, EventKind::phase, "The count is over", 2);
  }
  if (status().elapsed_s >= setup_.settings.rules.time_limit_s)
    endTrial(Outcome::time, "The time limit was reached", now_ns);
}

void PulseTask::receive(const trial::UserRequest& request, std::int64_t now_ns) {
  using trial::UserCommand;
  if (status().state != trial::TrialState::running) return;
  switch (part_) {
    case PulsePart::find:
      if (request.command == UserCommand::done) startCount(now_ns);
      return;
    case PulsePart::number:
      if (request.command == UserCommand::done) sayNumber(now_ns);
      if (request.command == UserCommand::choose) type(request.reason, now_ns);
      return;
    case PulsePart::rhythm:
      if (request.command == UserCommand::choose && request.reason.size() == 1)
        sayRhythm(request.reason[0] - '0', now_ns);
      return;
    case PulsePart::count:
    case PulsePart::none:
      return;
  }
}

void PulseTask::startCount(std::int64_t now_ns) {
  if (listener_.marks() == 0) {
    status().notice = "Mark it first: hold still on the pulse and press the button";
    return;
  }
  part_ = PulsePart::count;
  status().notice.clear();
  report(now_ns, EventKind::phase, "The count begins", 1);
}

/// A digit of it, or all of it at once, which is then said.
void PulseTask::type(const std::string& digits, std::int64_t now_ns) {
  if (!isNumber(digits)) return;
  if (digits.size() > 1) {
    typed_ = digits;
    return sayNumber(now_ns);
  }
  if (typed_.size() < kMostDigits) typed_ += digits;
}

void PulseTask::sayNumber(std::int64_t now_ns) {
  if (typed_.empty()) {
    status().notice = "Type the number of beats, then [D]";
    return;
  }
  const int beats = std::stoi(typed_);
  typed_.clear();
  status().notice.clear();
  said_.add(beats);
  report(now_ns, EventKind::answer, "Counted: " + std::to_string(beats) + " beats", beats);
  part_ = PulsePart::rhythm;
}

void PulseTask::sayRhythm(int number, std::int64_t now_ns) {
  if (number < 1 || number > kRhythmCount) return;
  said_.add(number);
  report(now_ns, EventKind::answer, std::string("The rhythm: ") + wordsOf(*said_.rhythm), number);
  endTrial(Outcome::done, "", now_ns);
}

void PulseTask::command(haptics::TickCommands& commands) const {
  commands.subtask = static_cast<std::uint8_t>(part_);
  commands.artery = patient().artery;
  commands.artery.beats = beats_;
}

void PulseTask::publishStatus(std::int64_t now_ns) {
  shown_.part = part_;
  if (status().trial > 0) shown_.artery = patient().name;
  shown_.typed = typed_;
  shown_.count_left_s = std::max(setup_.settings.rules.count_s - listener_.countedSeconds(), 0.0);
  shown_.force_N = listener_.now_N();
  shown_.mark_P = listener_.mark_P();
  static_cast<trial::TrialStatus&>(shown_) = status();
  channels_.status_to_scene.publish(shown_, now_ns);
}

}  // namespace palpa::task_pulse
