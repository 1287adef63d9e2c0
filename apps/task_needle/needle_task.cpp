#include "apps/task_needle/needle_task.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/assess/needle/needle_metrics.h"

namespace palpa::task_needle {

using runtime::EventKind;
using training::Outcome;
using training::Role;

namespace {

constexpr double kContactPause = 0.5;  // s without contact before the next one is news
constexpr double kRoom_s = 600, kTicksASecond = 1000;  // of the longest trial foreseen

std::string scoresJson(const assess::TrialAssessment& a) {
  const assess::ParacentesisValues& v = a.values;
  nlohmann::json scores{
      {"COL_LUNG", v.col_lung},       {"COL_RIB", v.col_rib},   {"COL_ART", v.col_art},
      {"COL_VEIN", v.col_vein},       {"PHASE_1", v.phase_1},   {"PHASE_2", v.phase_2},
      {"ECON_MEAN", v.econ_mean},     {"ECON_VAR", v.econ_var}, {"TIME", v.time_ms},
      {"SUCCESS", v.success ? 1 : 0}, {"TOTAL", a.total}};
  if (a.by_path) scores["RULES"] = a.rules;
  return scores.dump();
}

bool fades(const haptics::AugmentationPlan& plan) {
  return std::any_of(plan.each.begin(), plan.each.begin() + plan.count,
                     [](const haptics::Augmentation& a) { return a.fades != 0; });
}

/// Blood from the vein, and neither artery nor lung touched.
bool isClean(const assess::TrialAssessment& trial) {
  return trial.values.success && trial.values.col_lung == 0 && trial.values.col_art == 0;
}

}  // namespace

NeedleTask::NeedleTask(const NeedleTaskSetup& setup, runtime::Bus& bus, TaskChannels& channels,
                       runtime::Executive& executive)
    : TrialTask({static_cast<int>(setup.plan.size()), setup.automatic, setup.calibration_problem,
                 setup.places},
                bus, channels, executive),
      setup_(setup),
      channels_(channels),
      sampler_(setup.X_AD, setup.X_ET),
      doses_(setup.augmentations, setup.settings.augmentations.subtaskNames()),
      support_(fades(setup.augmentations)) {
  completed_.reserve(setup_.plan.size());
  // Once, so that a later and longer trial needs no more.
  samples_.reserve(
      static_cast<std::size_t>(kTicksASecond * std::min(setup.settings.time_limit_s, kRoom_s)));
}

/// What a recorded hand said comes as it came.
std::int64_t NeedleTask::step(std::int64_t now_ns) {
  for (; said_ < setup_.said.size() && setup_.said[said_].first <= now_ns; ++said_)
    channels_.operator_to_task.push(
        {trial::UserCommand::choose,
         std::to_string(1 + static_cast<int>(setup_.said[said_].second))});
  return TrialTask::step(now_ns);
}

std::string NeedleTask::notReady(const haptics::FlightRecord& last) const {
  return last.phase != haptics::NeedlePhase::outside || last.depth > 0
             ? "the needle is in the skin: take it out"
             : "";
}

runtime::TrialHeader NeedleTask::begin(std::int64_t now_ns) {
  shown_ = {};
  if (!setup_.settings.goal) shown_.step = assess::clinicalName(shown_.phase);
  sampler_.begin(static_cast<std::uint32_t>(status().trial));
  if (setup_.settings.goal)
    goal_ = GoalTrial(*setup_.settings.goal, setup_.settings.augmentations.subtaskNames(),
                      setup_.settings.words);
  doses_.begin(static_cast<std::uint32_t>(status().trial));
  phases_ = {};
  passes_ = {};
  samples_.clear();
  syringe_ = {};
  question_ = {};
  touched_s_.fill(-kContactPause);
  entered_vein_ = false;
  support(now_ns);
  const bool guided = supported_ > 0 && plan().role == Role::scored;
  picture("start", "Before the needle touches the " + setup_.settings.words.of(Organ::skin));
  return {status().trial,        now_ns,
          plan().seed,           training::nameOf(guided ? Role::guided : plan().role),
          plan().force_feedback, plan().puncture_force_N};
}

/// Of a trial of practice with cues that fade: how much of them is felt in it.
void NeedleTask::support(std::int64_t now_ns) {
  const bool may = plan().augmented && !training::inAssessment(plan().role);
  supported_ = may ? support_.in(status().trial) : 0;
  if (may && fades(setup_.augmentations))
    report(now_ns, EventKind::phase,
           supported_ > 0 ? "Guided by " + std::to_string(std::lround(100 * supported_)) +
                                " % of what leads the needle"
                          : "Nothing leads the needle in this trial");
}

assess::TrialAssessment judgedWithoutPath(const assess::TrialFacts& facts, const GoalTrial* goal,
                                          const std::vector<assess::TrialSample>& samples,
                                          const assess::ScoringRules& rules) {
  assess::TrialAssessment judged;
  judged.trial = facts.trial;
  judged.rules = rules.version;
  judged.role = facts.role;
  judged.outcome = facts.outcome;
  judged.seed = facts.seed;
  judged.simulated = facts.simulated;
  judged.force_feedback = facts.force_feedback;
  judged.values.success = facts.outcome == Outcome::success;
  if (goal) goal->describe(&judged);
  judged.metrics = assess::goalMetrics(judged, samples, rules);
  return judged;
}

trial::TrialTask::Conclusion NeedleTask::conclude(Outcome outcome, const std::string& reason) {
  CompletedTrial trial;
  trial.reason = reason;
  assess::TrialFacts facts{status().trial,        status().role, setup_.simulated,
                           plan().force_feedback, plan().seed,   outcome};
  if (setup_.taught_path) {
    trial.assessment = assess::assessTrial(facts, samples_, setup_.patient, setup_.query,
                                           *setup_.taught_path, setup_.settings.rules);
  } else {
    trial.assessment = judgedWithoutPath(facts, setup_.settings.goal ? &goal_ : nullptr, samples_,
                                         setup_.settings.rules);
  }
  trial.assessment.augmented = plan().augmented;
  if (plan().augmented && outcome != Outcome::voided && outcome != Outcome::aborted)
    support_.end(isClean(trial.assessment));
  trial.assessment.doses = doses_.doses();
  shown_.flows = Tissue::air;
  shown_.asked = false;
  const bool success = outcome == Outcome::success;
  completed_.push_back(std::move(trial));
  const std::string reached = setup_.settings.goal ? "Done: " + setup_.settings.goal->means
                                                   : "The end of the trial: the vein was reached";
  return {scoresJson(completed_.back().assessment), completed_.back().assessment.summary,
          setup_.settings.goal ? "Done. Trial ended" : "Vein reached. Trial ended",
          success ? reached : "The end of the trial"};
}

void NeedleTask::judge(const haptics::FlightRecord& record, std::int64_t now_ns) {
  doses_.add(record);
  assess::TrialSample sample;
  if (!sampler_.add(record, &sample)) return;
  const double dt = samples_.empty() ? 0 : sample.t_s - samples_.back().t_s;
  samples_.push_back(sample);
  phases_.add(sample);
  passes_.add(sample);
  if (setup_.settings.goal) goal_.add(sample);
  announce(sample, record.t_ns);
  shown_.step = setup_.settings.goal ? goal_.step() : assess::clinicalName(shown_.phase);
  status().elapsed_s = sample.t_s;
  aspirate(sample, dt, now_ns);
  if (status().active()) hearButtons(record, now_ns);
  if (!status().active()) return;
  if (setup_.settings.goal && goal_.reached()) return endTrial(Outcome::success, "", now_ns);
  if (const int most = plan().most_passes; most > 0 && passes_.passes() > most)
    return endTrial(Outcome::passes,
                    "Ended at needle pass " + std::to_string(most + 1) + ": no more than " +
                        std::to_string(most) + " are allowed",
                    now_ns);
  if (sample.t_s >= setup_.settings.time_limit_s)
    return endTrial(Outcome::time, "The time limit was reached", now_ns);
}

/// What comes into the syringe; where the rules ask, what it is taken for.
void NeedleTask::aspirate(const assess::TrialSample& sample, double dt, std::int64_t now_ns) {
  const assess::ScoringRules& rules = setup_.settings.rules;
  shown_.plunger = sample.plunger;
  shown_.flows = assess::aspiratedFrom(sample, rules);
  syringe_.add(sample, shown_.flows, sample.t_s - dt);
  shown_.blood = syringe_.blood();
  shown_.holds = syringe_.of();
  if (setup_.settings.goal) return;
  question_.add(shown_.flows, dt, rules);
  if (question_.asked() && rules.told_within_s == 0) return answerItself(now_ns);
  if (question_.asked() && !shown_.asked)
    report(now_ns, EventKind::phase, "It is asked what is aspirated");
  shown_.asked = question_.asked();
  shown_.answer_within_s = shown_.asked ? rules.told_within_s - question_.waited_s() : 0;
  if (shown_.asked && question_.waited_s() > rules.told_within_s)
    endTrial(
        Outcome::mistaken,
        std::string("It was not said what was aspirated: ") + assess::looksOf(question_.about()),
        now_ns);
}

/// Where nobody asks, blood that flows from the vein for long enough says it.
void NeedleTask::answerItself(std::int64_t now_ns) {
  question_.answered();
  if (question_.about() == Tissue::vein_lumen) endTrial(Outcome::success, "", now_ns);
}

/// A right word ends the trial in the vein; of artery or lung it only ends the question.
void NeedleTask::take(assess::Taken taken, std::int64_t now_ns) {
  if (!question_.asked()) return;
  const Tissue from = question_.about();
  question_.answered();
  shown_.asked = false;
  report(now_ns, EventKind::answer, std::string("Taken for: ") + assess::name(taken),
         1 + static_cast<int>(taken));
  if (!assess::isRight(taken, from))
    return endTrial(Outcome::mistaken,
                    std::string("What was aspirated, ") + assess::looksOf(from) +
                        ", was taken for: " + assess::name(taken),
                    now_ns);
  if (from == Tissue::vein_lumen) endTrial(Outcome::success, "", now_ns);
}

void NeedleTask::receive(const trial::UserRequest& request, std::int64_t now_ns) {
  if (request.command != trial::UserCommand::choose || request.reason.size() != 1) return;
  const int choice = request.reason[0] - '1';
  if (choice >= 0 && choice <= 2) take(static_cast<assess::Taken>(choice), now_ns);
}

void NeedleTask::hearButtons(const haptics::FlightRecord& record, std::int64_t now_ns) {
  const std::uint32_t pressed = record.reading.buttons & ~buttons_;
  buttons_ = record.reading.buttons;
  for (std::size_t i = 0; i < setup_.answers.size(); ++i)
    if (pressed & setup_.answers[i]) take(static_cast<assess::Taken>(i), now_ns);
}

/// Events in clinical words, and pictures of the moments that the report shows.
void NeedleTask::announce(const assess::TrialSample& sample, std::int64_t now_ns) {
  const TaskWords& words = setup_.settings.words;
  if (phases_.phase() != shown_.phase) {
    shown_.phase = phases_.phase();
    if (!setup_.settings.goal) report(now_ns, EventKind::phase, assess::clinicalName(shown_.phase));
    if (!setup_.settings.goal && shown_.phase == assess::ProcedurePhase::advance)
      picture("phase-2", "Phase 2 begins: the needle is directed behind the clavicle");
  }
  if (sample.events & haptics::kSkinPunctured) {
    const std::string punctured = "The " + words.of(Organ::skin) + " is punctured";
    report(now_ns, EventKind::puncture, punctured);
    picture("puncture", punctured);
  }
  if (sample.events & haptics::kWithdrawn)
    report(now_ns, EventKind::withdrawn, "The needle is out of the " + words.of(Organ::skin));
  if (sample.events & haptics::kWallPunctured && sample.wall != Organ::none)
    report(now_ns, EventKind::wall, "Wall punctured: " + words.of(sample.wall));
  Organ touching = sample.bone;
  if (sample.tissue == Tissue::lung || sample.wall == Organ::lung) touching = Organ::lung;
  if (sample.tissue == Tissue::artery_lumen || sample.wall == Organ::artery)
    touching = Organ::artery;
  if (sample.tissue == Tissue::vein_lumen && !entered_vein_) {
    entered_vein_ = true;
    report(now_ns, EventKind::vein, "The tip is in the vein");
    picture("vein", "The tip enters the vein");
  }
  if (touching == Organ::none) return;
  double& last_s = touched_s_[static_cast<std::size_t>(touching)];
  const bool again = sample.t_s - last_s < kContactPause;  // the same contact, trembling
  last_s = sample.t_s;
  if (again) return;
  report(now_ns, EventKind::touched, std::string("Touched: ") + palpa::name(touching));
  if (touching == Organ::lung || touching == Organ::artery ||
      (isBone(touching) && touching != Organ::clavicle))
    picture(palpa::name(touching),
            std::string("Error: the needle touches the ") + palpa::name(touching));
}

void NeedleTask::command(haptics::TickCommands& commands) const {
  commands.puncture_force_N = plan().puncture_force_N;
  commands.wall_scale = plan().wall_scale;
  commands.augmented = plan().augmented;
  commands.support = supported_;
  if (plan().augmented) {
    commands.line_p_D = setup_.fixtures.line_p_D;
    commands.line_a_D = setup_.fixtures.line_a_D;
    commands.kept_out = setup_.fixtures.kept_out;
  }
  commands.asked = shown_.asked;
  commands.subtask = static_cast<std::uint8_t>(shown_.phase);
}

void NeedleTask::publishStatus(std::int64_t now_ns) {
  static_cast<trial::TrialStatus&>(shown_) = status();
  channels_.status_to_scene.publish(shown_, now_ns);
}

}  // namespace palpa::task_needle
