#include "apps/task_search/search_task.h"

#include <algorithm>
#include <numbers>

#include <nlohmann/json.hpp>

namespace palpa::task_search {

using training::Outcome;

SearchListener::SearchListener(const SearchSettings& task, const haptics::AugmentationPlan& plan)
    : task_(&task), plan_(plan) {}

void SearchListener::begin(std::uint32_t trial) {
  *this = SearchListener(*task_, plan_);
  trial_ = trial;
  doses_ = assess::DoseCounter(plan_, task_->augmentations.subtaskNames());
}

void SearchListener::add(const haptics::FlightRecord& record, const Vec3& p_DT) {
  if (record.commands.trial != trial_) return;
  if (!record.commands.armed || record.commands.held) return clock_.pause();
  const double dt = clock_.pass(record.t_ns);
  const Vec3 way = p_DT - p_last_;
  p_last_ = p_DT;
  released_ = true;
  if (dt <= 0) return;
  path_ += way.norm();
  subtasks_ = record.subtasks;
  doses_.add(record, dt);
  const int element = (record.place & haptics::kPlaceElement) - 1;
  if (element >= 0) visited_[static_cast<std::size_t>(element)] += dt;
  if (record.place & haptics::kPlaceTouching) {
    const double N = (unpack(record.f_contact_D) + unpack(record.f_augmentation_D)).norm();
    peak_N_ = std::max(peak_N_, N);
    force_Ns_ += N * dt;
    contact_s_ += dt;
  }
  const bool in_pit =
      (record.place & haptics::kPlacePit) && (record.place & haptics::kPlaceTouching);
  dwell_s_ = in_pit && element == dwells_ ? dwell_s_ + dt : 0;
  dwells_ = in_pit ? element : -1;
  if (chosen_ < 0 && dwell_s_ >= task_->dwell_s) chosen_ = element;
}

assess::SearchTrial SearchListener::observed(assess::SearchTrial facts) const {
  facts.chosen = chosen_;
  facts.seconds = clock_.seconds();
  facts.path_m = path_;
  facts.peak_force_N = peak_N_;
  facts.mean_force_N = contact_s_ > 0 ? force_Ns_ / contact_s_ : 0;
  facts.visited_s = visited_;
  facts.doses = doses_.doses();
  return facts;
}

namespace {

constexpr double kNearStart_U = 10;
constexpr double kPatience_s = 5;  // then the handle is let go wherever it is

}  // namespace

Vec3 tipOf(const haptics::TickConfig& config, const haptics::DeviceReading& reading) {
  return unpack(reading.p_DE) + unpack(reading.q_DE).normalized() * unpack(config.X_ET.p);
}

void commandLoop(const Episode& episode, haptics::TickCommands* commands) {
  commands->floor = commands->trial;
  commands->degraded = episode.mode != assess::SearchMode::real;
  commands->augmented = episode.mode == assess::SearchMode::augmented;
}

assess::SearchTrial judged(assess::SearchTrial facts, const Episode& episode,
                           const SearchListener& listener) {
  facts.block = episode.block;
  facts.mode = episode.mode;
  facts.orientation_deg = episode.stimulus.orientation * 180 / std::numbers::pi;
  facts.target = episode.stimulus.target;
  return listener.observed(std::move(facts));
}

std::string scoreJson(const assess::SearchTrial& trial) {
  nlohmann::json doses = nlohmann::json::array();
  for (const assess::SubtaskDose& dose : trial.doses)
    doses.push_back({{"SUBTASK", dose.subtask},
                     {"ON_S", dose.on_s},
                     {"TIMES", dose.times},
                     {"AUGMENTED_S", dose.augmented_s},
                     {"IMPULSE_NS", dose.impulse_Ns}});
  return nlohmann::json{{"FOUND", trial.found() ? 1 : 0},
                        {"CHOSEN", trial.chosen},
                        {"TARGET", trial.target},
                        {"MODE", assess::name(trial.mode)},
                        {"TIME_S", trial.seconds},
                        {"PATH_M", trial.path_m},
                        {"DOSES", doses}}
      .dump();
}

SearchTask::SearchTask(const SearchTaskSetup& setup, Floors& floors, runtime::Bus& bus,
                       SearchChannels& channels, runtime::Executive& executive)
    : TrialTask({static_cast<int>(setup.episodes.size()), setup.automatic, setup.not_scored,
                 setup.places},
                bus, channels, executive),
      setup_(setup),
      floors_(floors),
      channels_(channels),
      listener_(setup.settings, setup.tick.augmentations) {
  completed_.reserve(setup.episodes.size());
  floors_.prepare(1);
}

std::string SearchTask::notReady(const haptics::FlightRecord&) const {
  return floors_.ready(static_cast<std::uint32_t>(status().trial + 1), setup_.waits)
             ? ""
             : "the floor is being prepared";
}

runtime::TrialHeader SearchTask::begin(std::int64_t now_ns) {
  const auto number = static_cast<std::uint32_t>(status().trial);
  held_ = true;
  began_ns_ = now_ns;
  listener_.begin(number);
  floors_.prepare(number + 1);
  const training::Role role = setup_.not_scored.empty() ? setup_.role : training::Role::not_scored;
  report(now_ns, runtime::EventKind::trial_case, episodeText(episode()));
  picture("start", "The handle is held over the middle");
  return {status().trial, now_ns, episode().seed, training::nameOf(role), setup_.force_feedback, 0};
}

trial::TrialTask::Conclusion SearchTask::conclude(Outcome outcome, const std::string& reason) {
  assess::SearchTrial facts;
  facts.trial = status().trial;
  facts.role = status().role;
  facts.simulated = setup_.simulated;
  facts.force_feedback = setup_.force_feedback;
  facts.seed = episode().seed;
  facts.outcome = outcome;
  completed_.push_back({judged(facts, episode(), listener_), reason});
  const assess::SearchTrial& trial = completed_.back().trial;
  const std::string summary = summaryOf(trial);
  return {scoreJson(trial), summary, summary, "Where the probe stayed"};
}

/// Once it has been held for a while and is where an episode starts.
void SearchTask::letGo(const haptics::FlightRecord& record, std::int64_t now_ns) {
  const double held_s = 1e-9 * static_cast<double>(record.t_ns - began_ns_);
  if (held_s < setup_.settings.hold_s) return;
  const Vec3 p_F = unpack(setup_.tick.X_DF).inverse() * tipOf(setup_.tick, record.reading);
  const haptics::FloorRendering& floor = setup_.tick.floor;
  const bool there = (p_F / floor.unit - Vec3(0, 0, floor.start_height)).norm() < kNearStart_U;
  if (!there && held_s < setup_.settings.hold_s + kPatience_s) return;
  held_ = false;
  report(now_ns, runtime::EventKind::let_go, "The handle is let go");
}

void SearchTask::judge(const haptics::FlightRecord& record, std::int64_t now_ns) {
  if (held_) letGo(record, now_ns);
  listener_.add(record, tipOf(setup_.tick, record.reading));
  status().elapsed_s = listener_.seconds();
  if (listener_.chosen() >= 0)
    endTrial(Outcome::done, "", now_ns);
  else if (status().elapsed_s >= setup_.settings.time_limit_s)
    endTrial(Outcome::time, "The time limit was reached", now_ns);
}

void SearchTask::command(haptics::TickCommands& commands) const {
  commandLoop(episode(), &commands);
  commands.held = held_;
}

void SearchTask::publishStatus(std::int64_t now_ns) {
  if (status().trial > 0) {
    shown_.mode = episode().mode;
    shown_.block = episode().block;
  }
  shown_.held = held_;
  static_cast<trial::TrialStatus&>(shown_) = status();
  channels_.status_to_scene.publish(shown_, now_ns);
}

}  // namespace palpa::task_search
