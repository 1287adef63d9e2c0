#include "apps/task_comparison/comparison_task.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace palpa::task_comparison {

using runtime::EventKind;
using training::Outcome;

namespace {

constexpr double kLongestGap_s = 0.1,
                 kGrip_s = 0.1;  // longer: it was paused; shorter: it was no grip

double sensedN(const haptics::FlightRecord& r) {
  return r.sensed.state == haptics::SensorState::valid ? unpack(r.sensed.f_D).norm() : 0;
}
double feltN(const haptics::FlightRecord& r) {
  return (unpack(r.sensed.f_D) + unpack(r.f_command_D)).norm();
}

}  // namespace

void commandLoop(const Comparison& comparison, int thing, haptics::TickCommands* commands) {
  const auto factor = static_cast<float>(comparison.factors[static_cast<std::size_t>(thing)]);
  commands->squeeze_stiffness =
      comparison.property == assess::ComparedProperty::stiffness ? factor : 1;
  commands->squeeze_weight = comparison.property == assess::ComparedProperty::weight ? factor : 1;
}

void ComparisonListener::begin(std::uint32_t trial, const Comparison& comparison) {
  *this = ComparisonListener(touch_);
  trial_ = trial;
  comparison_ = comparison;
}

int ComparisonListener::thing(const haptics::TickCommands& commands) const {
  haptics::TickCommands second;
  commandLoop(comparison_, 1, &second);
  return commands.squeeze_stiffness == second.squeeze_stiffness &&
                 commands.squeeze_weight == second.squeeze_weight
             ? 1
             : 0;
}

void ComparisonListener::add(const haptics::FlightRecord& record) {
  if (record.commands.trial != trial_ || !record.commands.armed) return;
  if (record.tool == 0) {
    first_ = record;
    return;
  }
  const double dt = last_ns_ < 0 ? 0 : 1e-9 * static_cast<double>(record.t_ns - last_ns_);
  last_ns_ = record.t_ns;
  if (dt <= 0 || dt > kLongestGap_s) return;
  seconds_ += dt;
  const bool both = sensedN(first_) >= touch_ && sensedN(record) >= touch_;
  const double before = held_s_;
  held_s_ = both ? held_s_ + dt : 0;
  if (before < kGrip_s && held_s_ >= kGrip_s)
    ++grips_[static_cast<std::size_t>(thing(record.commands))];
  now_N_ = both ? std::min(feltN(first_), feltN(record)) : 0;
  peak_ = std::max(peak_, now_N_);
}

assess::ComparisonTrial judged(assess::ComparisonTrial facts, const Comparison& comparison,
                            const ComparisonListener& listener, int said) {
  facts.property = comparison.property;
  facts.factors = comparison.factors;
  facts.said = said;
  facts.seconds = listener.seconds();
  facts.peak_N = listener.peak();
  facts.grips = listener.grips();
  return facts;
}

std::string scoreJson(const assess::ComparisonTrial& trial) {
  return nlohmann::json{{"RIGHT", trial.right() ? 1 : 0},
                        {"SAID", trial.said},
                        {"PEAK_N", trial.peak_N},
                        {"TIME_S", trial.seconds},
                        {"GRIPS", trial.grips}}
      .dump();
}

ComparisonTask::ComparisonTask(const ComparisonTaskSetup& setup, runtime::Bus& bus,
                         ComparisonChannels& channels, runtime::Executive& executive)
    : TrialTask({static_cast<int>(setup.comparisons.size()), setup.automatic, setup.not_scored,
                 setup.places, 2},
                bus, channels, executive),
      setup_(setup),
      channels_(channels),
      listener_(setup.settings.touch) {
  completed_.reserve(setup.comparisons.size());
}

std::string ComparisonTask::notReady(const haptics::FlightRecord&) const {
  for (std::size_t t = 0; t < 2; ++t) {
    const std::string which = t == 0 ? "the first" : "the second";
    if (!last_of_[t].reading.homed) return which + " device is not homed";
    if (last_of_[t].sensed.state != haptics::SensorState::valid)
      return which + " force sensor gives no reading that can be used";
    if (unpack(last_of_[t].sensed.f_D).norm() >= setup_.settings.touch)
      return which + " tool touches something: let go";
  }
  return "";
}

runtime::TrialHeader ComparisonTask::begin(std::int64_t now_ns) {
  thing_ = said_ = 0;
  listener_.begin(static_cast<std::uint32_t>(status().trial), comparison());
  const training::Role role = setup_.not_scored.empty() ? setup_.role : training::Role::not_scored;
  report(now_ns, EventKind::trial_case, comparisonText(comparison()));
  picture("start", "Before anything was held");
  return {status().trial, now_ns, setup_.seed, training::nameOf(role), setup_.force_feedback, 0};
}

trial::TrialTask::Conclusion ComparisonTask::conclude(Outcome outcome, const std::string& reason) {
  assess::ComparisonTrial facts;
  facts.trial = status().trial;
  facts.role = status().role;
  facts.simulated = setup_.simulated;
  facts.force_feedback = setup_.force_feedback;
  facts.seed = setup_.seed;
  facts.outcome = outcome;
  completed_.push_back({judged(facts, comparison(), listener_, said_), reason});
  const assess::ComparisonTrial& trial = completed_.back().trial;
  const std::string summary = summaryOf(trial);
  return {scoreJson(trial), summary, summary, "After the answer"};
}

void ComparisonTask::judge(const haptics::FlightRecord& record, std::int64_t now_ns) {
  const int grips = listener_.grips()[0] + listener_.grips()[1];
  listener_.add(record);
  if (listener_.grips()[0] + listener_.grips()[1] > grips)
    picture("held", thing_ == 0 ? "The first thing is held" : "The second thing is held");
  status().elapsed_s = listener_.seconds();
  if (status().elapsed_s >= setup_.settings.time_limit_s)
    endTrial(Outcome::time, "The time limit was reached", now_ns);
}

void ComparisonTask::receive(const trial::UserRequest& request, std::int64_t now_ns) {
  if (request.command == trial::UserCommand::done) return otherThing(now_ns);
  answer(trial::gradeOf(request).hardness, now_ns);
}

/// What is held must not change in the hand.
void ComparisonTask::otherThing(std::int64_t now_ns) {
  if (listener_.held()) {
    status().notice = "Let go first: then comes the other thing";
    return;
  }
  thing_ = 1 - thing_;
  status().notice.clear();
  report(now_ns, EventKind::thing,
         thing_ == 0 ? "The first thing lies there" : "The second thing lies there", thing_ + 1);
}

void ComparisonTask::answer(int said, std::int64_t now_ns) {
  if (said != 1 && said != 2) return;
  if (listener_.grips()[0] == 0 || listener_.grips()[1] == 0) {
    status().notice = "Hold both first, the one and the other";
    return;
  }
  said_ = said;
  report(now_ns, EventKind::answer,
         said == 1 ? "The first one has more" : "The second one has more", said);
  endTrial(Outcome::done, "", now_ns);
}

void ComparisonTask::command(haptics::TickCommands& commands) const {
  commandLoop(comparison(), thing_, &commands);
}

void ComparisonTask::publishStatus(std::int64_t now_ns) {
  if (status().trial > 0) shown_.property = comparison().property;
  shown_.thing = thing_;
  shown_.squeezed_N = listener_.now_N();
  shown_.held = listener_.held();
  static_cast<trial::TrialStatus&>(shown_) = status();
  channels_.status_to_scene.publish(shown_, now_ns);
}

}  // namespace palpa::task_comparison
