#include "apps/task_comparison/comparison_task.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <nlohmann/json.hpp>

namespace palpa::task_comparison {

using assess::ComparedProperty;
using runtime::EventKind;
using training::Outcome;

namespace {

constexpr double kTouch_s = 0.1;  // shorter: it was no touch

double sensedN(const haptics::FlightRecord& r) {
  return r.sensed.state == haptics::SensorState::valid ? unpack(r.sensed.f_D).norm() : 0;
}
double feltN(const haptics::FlightRecord& r) {
  return (unpack(r.sensed.f_D) + unpack(r.f_command_D)).norm();
}

/// "first", "second", ...: of as many things as a comparison can have.
const char* ordinal(int number) {
  static constexpr std::array kOrdinals{"first", "second",  "third",  "fourth", "fifth",
                                        "sixth", "seventh", "eighth", "next"};
  return kOrdinals[std::min(static_cast<std::size_t>(std::max(number - 1, 0)),
                            kOrdinals.size() - 1)];
}

}  // namespace

void commandLoop(const Comparison& comparison, int thing, haptics::TickCommands* commands) {
  const auto factor = static_cast<float>(comparison.factors[static_cast<std::size_t>(thing)]);
  const auto of = [&](ComparedProperty property) {
    return comparison.property == property ? factor : 1;
  };
  commands->squeeze_stiffness = of(ComparedProperty::stiffness);
  commands->squeeze_weight = of(ComparedProperty::weight);
  commands->friction = of(ComparedProperty::friction);
}

void ComparisonListener::begin(std::uint32_t trial, const Comparison& comparison) {
  *this = ComparisonListener(touch_, tools_);
  trial_ = trial;
  comparison_ = comparison;
  touches_.assign(comparison.factors.size(), 0);
}

int ComparisonListener::thing(const haptics::TickCommands& commands) const {
  for (int i = static_cast<int>(comparison_.factors.size()) - 1; i > 0; --i) {
    haptics::TickCommands its;
    commandLoop(comparison_, i, &its);
    if (commands.squeeze_stiffness == its.squeeze_stiffness &&
        commands.squeeze_weight == its.squeeze_weight && commands.friction == its.friction)
      return i;
  }
  return 0;
}

bool ComparisonListener::touchedAll() const {
  return std::find(touches_.begin(), touches_.end(), 0) == touches_.end();
}

int ComparisonListener::allTouches() const {
  return std::accumulate(touches_.begin(), touches_.end(), 0);
}

void ComparisonListener::add(const haptics::FlightRecord& record) {
  if (record.commands.trial != trial_) return;
  if (!record.commands.armed) return clock_.pause();
  if (tools_ == 2 && record.tool == 0) {
    first_ = record;
    return;
  }
  const double dt = clock_.pass(record.t_ns);
  if (dt <= 0) return;
  const bool touching = sensedN(record) >= touch_ && (tools_ == 1 || sensedN(first_) >= touch_);
  const double before = touch_s_;
  touch_s_ = touching ? touch_s_ + dt : 0;
  if (before < kTouch_s && touch_s_ >= kTouch_s)
    ++touches_[static_cast<std::size_t>(thing(record.commands))];
  now_N_ = !touching ? 0 : tools_ == 1 ? feltN(record) : std::min(feltN(first_), feltN(record));
  peak_ = std::max(peak_, now_N_);
}

void Answer::add(double value, bool sorting) {
  if (sorting)
    order.push_back(static_cast<int>(std::lround(std::clamp(value, 0.0, 100.0))));
  else
    more = value == 1 ? 1 : value == 2 ? 2 : 0;
}

assess::ComparisonTrial judged(assess::ComparisonTrial facts, const Comparison& comparison,
                               const ComparisonListener& listener, const Answer& said) {
  facts.property = comparison.property;
  facts.factors = comparison.factors;
  facts.said = said.more;
  facts.order = said.order;
  facts.seconds = listener.seconds();
  facts.peak_N = listener.peak();
  facts.touches = listener.touches();
  return facts;
}

std::string scoreJson(const assess::ComparisonTrial& trial) {
  nlohmann::json score{
      {"RIGHT", trial.right() ? 1 : 0}, {"PEAK_N", trial.peak_N}, {"TIME_S", trial.seconds}};
  score[trial.property == ComparedProperty::friction ? "TOUCHES" : "GRIPS"] = trial.touches;
  if (!trial.sorting()) {
    score["SAID"] = trial.said;
    return score.dump();
  }
  score["MODE"] = "put in order";
  score["ORDER"] = trial.order;
  if (const std::optional<double> tau = trial.tau()) score["TAU"] = *tau;
  return score.dump();
}

ComparisonTask::ComparisonTask(const ComparisonTaskSetup& setup, runtime::Bus& bus,
                               ComparisonChannels& channels, runtime::Executive& executive)
    : TrialTask({static_cast<int>(setup.comparisons.size()), setup.automatic, setup.not_scored,
                 setup.places, setup.tools},
                bus, channels, executive),
      setup_(setup),
      channels_(channels),
      listener_(setup.settings.touch, setup.tools) {
  completed_.reserve(setup.comparisons.size());
}

std::string ComparisonTask::notReady(const haptics::FlightRecord&) const {
  for (std::size_t t = 0; t < static_cast<std::size_t>(setup_.tools); ++t) {
    const std::string which = setup_.tools == 1 ? "the" : t == 0 ? "the first" : "the second";
    if (!last_of_[t].reading.homed) return which + " device is not homed";
    if (last_of_[t].sensed.state != haptics::SensorState::valid)
      return which + " force sensor gives no reading that can be used";
    if (unpack(last_of_[t].sensed.f_D).norm() >= setup_.settings.touch)
      return which + " tool touches something: " + (setup_.tools == 1 ? "lift it" : "let go");
  }
  return "";
}

runtime::TrialHeader ComparisonTask::begin(std::int64_t now_ns) {
  thing_ = 0;
  said_ = {};
  listener_.begin(static_cast<std::uint32_t>(status().trial), comparison());
  const training::Role role = setup_.not_scored.empty() ? setup_.role : training::Role::not_scored;
  report(now_ns, EventKind::trial_case, comparisonText(comparison()));
  picture("start", setup_.tools == 1 ? "Before anything was touched" : "Before anything was held");
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
  const int touches = listener_.allTouches();
  listener_.add(record);
  if (listener_.allTouches() > touches)
    picture(setup_.tools == 1 ? "stroked" : "held",
            std::string("The ") + ordinal(thing_ + 1) +
                (setup_.tools == 1 ? " surface is touched" : " thing is held"));
  status().elapsed_s = listener_.seconds();
  const double limit_s = sorting() ? setup_.settings.sort_limit_s : setup_.settings.time_limit_s;
  if (status().elapsed_s >= limit_s) endTrial(Outcome::time, "The time limit was reached", now_ns);
}

void ComparisonTask::receive(const trial::UserRequest& request, std::int64_t now_ns) {
  if (request.command == trial::UserCommand::done) return nextThing(now_ns);
  if (!sorting()) return answer(trial::gradeOf(request).hardness, now_ns);
  if (request.command == trial::UserCommand::choose && request.reason.size() == 1)
    putInOrder(request.reason[0] - '0', now_ns);
}

/// What is touched must not change under the hand.
void ComparisonTask::nextThing(std::int64_t now_ns) {
  if (listener_.touching()) {
    status().notice = setup_.tools == 1 ? "Lift first: then comes the next surface"
                                        : "Let go first: then comes the other thing";
    return;
  }
  thing_ = (thing_ + 1) % things();
  status().notice.clear();
  report(now_ns, EventKind::thing,
         std::string("The ") + ordinal(thing_ + 1) +
             (setup_.tools == 1 ? " surface lies there" : " thing lies there"),
         thing_ + 1);
}

bool ComparisonTask::mayAnswer() {
  if (listener_.touchedAll()) return true;
  status().notice = sorting()           ? "Stroke over each of them first"
                    : setup_.tools == 1 ? "Stroke over both first, the one and the other"
                                        : "Hold both first, the one and the other";
  return false;
}

void ComparisonTask::answer(int said, std::int64_t now_ns) {
  if ((said != 1 && said != 2) || !mayAnswer()) return;
  said_.add(said, false);
  report(now_ns, EventKind::answer,
         said == 1 ? "The first one has more" : "The second one has more", said);
  endTrial(Outcome::done, "", now_ns);
}

/// From the smoothest on; the last one follows from the others, but is said, too.
void ComparisonTask::putInOrder(int number, std::int64_t now_ns) {
  if (number < 1 || number > things() || !mayAnswer()) return;
  if (std::find(said_.order.begin(), said_.order.end(), number) != said_.order.end()) {
    status().notice = "Number " + std::to_string(number) + " was said already";
    return;
  }
  status().notice.clear();
  said_.add(number, true);
  report(now_ns, EventKind::answer,
         std::string("The ") + ordinal(number) + " surface is the " +
             ordinal(static_cast<int>(said_.order.size())) + " from the smoothest",
         number);
  if (static_cast<int>(said_.order.size()) == things()) endTrial(Outcome::done, "", now_ns);
}

void ComparisonTask::command(haptics::TickCommands& commands) const {
  commandLoop(comparison(), thing_, &commands);
}

void ComparisonTask::publishStatus(std::int64_t now_ns) {
  if (status().trial > 0) {
    shown_.property = comparison().property;
    shown_.things = things();
  }
  shown_.thing = thing_;
  shown_.force_N = listener_.now_N();
  shown_.touching = listener_.touching();
  shown_.order = said_.order;
  static_cast<trial::TrialStatus&>(shown_) = status();
  channels_.status_to_scene.publish(shown_, now_ns);
}

}  // namespace palpa::task_comparison
