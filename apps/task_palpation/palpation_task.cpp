#include "apps/task_palpation/palpation_task.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "scene/scene_state.h"

namespace palpa::task_palpation {

using runtime::EventKind;
using training::Outcome;
using training::Role;

namespace {

constexpr std::int64_t kEvery_ns = 10'000'000;
constexpr const char* kTakenAway = "the real lump is taken away";

}  // namespace

namespace {

const haptics::TickConfig& secondOf(const haptics::TickConfig& config,
                                    const std::optional<haptics::PairConfig>& pair) {
  return pair ? pair->tools[1] : config;
}

}  // namespace

PalpationListener::PalpationListener(const haptics::TickConfig& config,
                                     const std::optional<haptics::PairConfig>& pair)
    : X_PD_{unpack(config.X_DP).inverse(), unpack(secondOf(config, pair).X_DP).inverse()},
      X_ET_(unpack(config.X_ET)),
      top_(config.top),
      radius_(config.touch.tip_radius) {}

void PalpationListener::begin(std::uint32_t trial) {
  trial_ = trial;
  clock_ = {};
  kept_ns_ = {-1, -1};
  pressed_ = true;  // a button that is down already marks nothing
  samples_.clear();
  marks_.clear();
}

Vec3 PalpationListener::tipMiddle(const haptics::FlightRecord& record) const {
  const Pose X_DE = makePose(unpack(record.reading.q_DE).normalized().toRotationMatrix(),
                             unpack(record.reading.p_DE));
  return X_PD_[record.tool & 1] * (X_DE * (X_ET_ * Vec3(0, 0, -radius_)));
}

bool PalpationListener::add(const haptics::FlightRecord& record) {
  if (record.commands.trial != trial_) return false;
  const std::size_t tool = record.tool & 1;
  if (!record.commands.armed || !record.reading.homed) {
    if (tool != 0) return false;
    clock_.pause();
    pressed_ = true;  // what is pressed over a pause marks nothing
    return false;
  }
  const TopFoot foot = nearestOn(top_, tipMiddle(record));
  const Vec3 p_P(foot.p.x(), foot.p.y(), foot.over - radius_);
  if (tool == 0) {
    clock_.pass(record.t_ns);
    const bool down = (record.reading.buttons & kMark) != 0;
    if (down && !pressed_ && p_P.z() < kOver) marks_.push_back({seconds(), p_P, 0, 0, 0});
    pressed_ = down;
  }
  if (kept_ns_[tool] >= 0 && record.t_ns - kept_ns_[tool] < kEvery_ns) return false;
  kept_ns_[tool] = record.t_ns;
  const Vec3 f_D = unpack(record.sensed.f_D) + unpack(record.f_command_D);
  const Vec3 f_P = X_PD_[tool].linear() * f_D;
  const double f_n = top_.flat() ? f_P.z() : f_P.dot(foot.n);
  samples_.push_back({seconds(), p_P, std::max(f_n, 0.0), static_cast<int>(tool)});
  return true;
}

void PalpationListener::grade(double diameter, int hardness, int mobility, std::size_t mark) {
  if (marks_.empty() || mark > marks_.size()) return;
  assess::LumpMark& graded = marks_[(mark > 0 ? mark : marks_.size()) - 1];
  if (diameter > 0) graded.diameter = diameter;
  if (hardness > 0) graded.hardness = hardness;
  if (mobility > 0) graded.mobility = mobility;
}

double pressing(assess::PalpationSamples samples) {
  if (samples.empty()) return 0;
  const assess::PalpationSample& last = samples.back();
  if (samples.size() < 2 || samples[samples.size() - 2].tool == last.tool) return last.f_n;
  return std::max(last.f_n, samples[samples.size() - 2].f_n);
}

int levelOf(const assess::PressureLevels& levels, double f) {
  int level = 0;
  for (const double from : levels) level += f >= from;
  return level;
}

std::vector<std::uint8_t> levelsOf(const assess::CoverageMap& map) {
  std::vector<std::uint8_t> levels;
  for (int row = 0; row < map.rows(); ++row)
    for (int column = 0; column < map.columns(); ++column)
      levels.push_back(map.asked(column, row) ? static_cast<std::uint8_t>(map.level(column, row))
                                              : scene::CoverageGrid::kNotAsked);
  return levels;
}

std::string scoreJson(const assess::PalpationAssessment& a) {
  return nlohmann::json{{"FOUND", a.score.found},
                        {"MISSED", a.score.missed},
                        {"FALSE_ALARMS", a.score.false_alarms},
                        {"COVERAGE", a.score.coverage[0]},
                        {"PEAK_N", a.score.peak},
                        {"TIME_S", a.score.seconds},
                        {"GUIDED", a.facts.guided},
                        {"AT_STANDARD", a.passed ? 1 : 0}}
      .dump();
}

std::string caseText(const std::vector<assess::CaseLump>& lumps, bool taken_away) {
  nlohmann::json list = nlohmann::json::array();
  for (const assess::CaseLump& lump : lumps)
    list.push_back({{"p_P_m", pack(lump.p_P)},
                    {"diameter_m", lump.diameter},
                    {"hardness", lump.hardness},
                    {"mobility", lump.mobility}});
  if (taken_away) list.push_back(kTakenAway);
  return list.dump();
}

bool takenIn(const std::string& text) { return text.find(kTakenAway) != std::string::npos; }

std::vector<assess::CaseLump> caseOf(const std::string& text) {
  try {
    std::vector<assess::CaseLump> lumps;
    for (const nlohmann::json& lump : parseJson(text))
      if (lump != kTakenAway)
        lumps.push_back({unpack(lump.at("p_P_m").get<Packed3>()),
                         lump.at("diameter_m").get<double>(), lump.at("hardness").get<int>(),
                         lump.at("mobility").get<int>()});
    return lumps;
  } catch (const nlohmann::json::exception& e) {
    throw Error("does not describe lumps (" + whyNoJson(text, e) + ")", "event \"case\"",
                "Restore the file from a backup");
  }
}

PalpationTask::PalpationTask(const PalpationTaskSetup& setup, runtime::Bus& bus,
                             PalpationChannels& channels, runtime::Executive& executive)
    : TrialTask({static_cast<int>(setup.plan.size()), setup.automatic, setup.not_scored,
                 setup.places, setup.pair ? 2 : 1},
                bus, channels, executive),
      setup_(setup),
      channels_(channels),
      listener_(setup.tick, setup.pair),
      doses_(setup.tick.augmentations, setup.settings.augmentations.subtaskNames()),
      sensors_{SensorCheck(setup.tick), SensorCheck(secondOf(setup.tick, setup.pair))},
      map_(setup.settings.scoring.rules.area, setup.settings.scoring.rules.levels,
           setup.settings.scoring.rules.reach),
      guidance_(setup.guided) {
  completed_.reserve(setup.plan.size());
  shown_.columns = map_.columns();
  shown_.rows = map_.rows();
}

/// Of every tool there is.
std::string PalpationTask::notReady(const haptics::FlightRecord&) const {
  for (std::size_t t = 0; t < (setup_.pair ? 2u : 1u); ++t) {
    const haptics::FlightRecord& last = last_of_[t];
    const std::string which = !setup_.pair ? "" : t == 0 ? "first " : "second ";
    if (t == 1 && setup_.pair->estimated) {
      if (!last.reading.homed) return "the second finger is not tracked";
      continue;
    }
    if (last.sensed.state != haptics::SensorState::valid)
      return "the " + which + "force sensor gives no reading that can be used";
    if (unpack(last.sensed.f_D).norm() < setup_.settings.scoring.rules.touch) continue;
    if (sensors_[t].inTheAir(last) == 0) return "the " + which + "tool touches something: lift it";
    return "the " + which +
           "force sensor shows a force though nothing is touched: it has drifted, or its scale is "
           "wrong. Zero it again";
  }
  return "";
}

runtime::TrialHeader PalpationTask::begin(std::int64_t now_ns) {
  case_ = drawCase(setup_.settings, plan().seed);
  if (!plan().force_feedback) case_ = withoutForce(case_);
  placed_ = placed(case_, setup_.settings.anatomy,
                   setup_.settings.real ? setup_.settings.real->share : 1, top());
  listener_.begin(static_cast<std::uint32_t>(status().trial));
  doses_.begin(static_cast<std::uint32_t>(status().trial));
  for (SensorCheck& sensor : sensors_) sensor.reset();
  map_ =
      assess::CoverageMap(setup_.settings.scoring.rules.area, setup_.settings.scoring.rules.levels,
                          setup_.settings.scoring.rules.reach);
  guidance_.begin(status().trial);
  shown_.levels.clear();
  shown_.marks_P.clear();
  showLumps(nullptr);
  report(now_ns, EventKind::trial_case,
         caseText(lumpsOf(case_, setup_.settings.library), takesAway(case_)));
  picture("start", "Before anything was felt");
  const bool guided = plan().role == Role::scored && guidance_.helps(status().trial);
  const Role role =
      guided ? Role::guided : plan().role;  // trials without any help are those that count
  return {status().trial, now_ns, plan().seed, training::nameOf(role), plan().force_feedback, 0};
}

/// While a trial runs only where they may be seen; after it all, found or missed.
void PalpationTask::showLumps(const assess::PalpationAssessment* judged) {
  shown_.lumps.clear();
  if (!judged && !setup_.see_through) return;
  const std::vector<assess::CaseLump> lumps = lumpsOf(case_, setup_.settings.library);
  for (std::size_t i = 0; i < lumps.size(); ++i)
    shown_.lumps.push_back({fromTop(top(), lumps[i].p_P), lumps[i].diameter / 2,
                            judged && judged->score.lumps[i].mark >= 0, false});
  for (const assess::CaseLump& piece : lumpsOf(setup_.settings.anatomy, setup_.settings.library))
    shown_.lumps.push_back({fromTop(top(), piece.p_P), piece.diameter / 2, false, true});
}

trial::TrialTask::Conclusion PalpationTask::conclude(Outcome outcome, const std::string& reason) {
  CompletedPalpation trial;
  trial.reason = reason;
  const double seconds = listener_.seconds();
  const assess::PalpationFacts facts{status().trial,
                                     status().role,
                                     setup_.simulated,
                                     plan().force_feedback,
                                     plan().seed,
                                     outcome,
                                     seconds > 0 ? guidance_.shown_s() / seconds : 0,
                                     plan().augmented,
                                     takesAway(case_)};
  trial.assessment = assess::assessPalpation(
      facts, setup_.settings.scoring.rules, setup_.settings.scoring.standard,
      lumpsOf(case_, setup_.settings.library), listener_.samples(), listener_.marks());
  trial.assessment.doses = doses_.doses();
  if (outcome == Outcome::done || outcome == Outcome::time)
    guidance_.end(trial.assessment.score.coverage[0] >= setup_.settings.scoring.standard.coverage);
  showLumps(&trial.assessment);
  shown_.levels = levelsOf(map_);
  shown_.lead_P.reset();
  completed_.push_back(std::move(trial));
  const assess::PalpationAssessment& judged = completed_.back().assessment;
  return {scoreJson(judged), judged.summary, judged.summary, "The end of the search"};
}

void PalpationTask::judge(const haptics::FlightRecord& record, std::int64_t now_ns) {
  if (status().state == trial::TrialState::running) {
    SensorCheck& sensor = sensors_[record.tool & 1];
    if (const std::string trouble = sensor.add(record); !trouble.empty()) {
      sensor.reset();
      const char* const which = record.tool == 0 ? "of the first tool, " : "of the second tool, ";
      return hold((setup_.pair ? which : "") + trouble, now_ns);
    }
  }
  const std::size_t marks = listener_.marks().size();
  if (record.tool == 0) doses_.add(record);
  const bool kept = listener_.add(record);
  if (listener_.marks().size() > marks) {
    shown_.marks_P.push_back(listener_.marks().back().p_P);
    report(record.t_ns, EventKind::mark, "The trainee marks a lump");
    picture("mark", "Marked: here is one");
  }
  if (!kept) return;
  map_.add(listener_.samples().back());
  shown_.pressed_N = pressing(listener_.samples());
  shown_.level = levelOf(setup_.settings.scoring.rules.levels, shown_.pressed_N);
  status().elapsed_s = listener_.seconds();
  const bool whole = !setup_.pair || record.tool == 1;  // a tick is judged of both
  if (whole && status().elapsed_s >= setup_.settings.time_limit_s)
    endTrial(Outcome::time, "The time limit was reached", now_ns);
}

void PalpationTask::receive(const trial::UserRequest& request, std::int64_t now_ns) {
  if (request.command == trial::UserCommand::done) return endTrial(Outcome::done, "", now_ns);
  if (listener_.marks().empty()) return;
  const trial::Grade grade = trial::gradeOf(request);
  listener_.grade(grade.diameter, grade.hardness, grade.mobility);
  report(now_ns, EventKind::grade, trial::gradeText(grade.diameter, grade.hardness, grade.mobility),
         static_cast<double>(listener_.marks().size()));
}

/// After a mark it asks for what is still to be said of it: each answer shows as the next question.
std::string PalpationTask::doing() const {
  if (!listener_.marks().empty()) {
    const assess::LumpMark& mark = listener_.marks().back();
    const std::string which = "Mark " + std::to_string(listener_.marks().size());
    if (mark.hardness == 0) return which + ": how does it feel? 1 soft, 2 hard";
    if (mark.mobility == 0) return which + ": does it move? 3 fixed, 4 mobile";
    if (!(mark.diameter > 0)) return which + ": how large? 5: 10 mm, 6: 15, 7: 20, 8: 25";
  }
  return "Felt a lump? The device's button, or [M] with a mouse. Finished? [D]";
}

void PalpationTask::command(haptics::TickCommands& commands) const {
  commands.lumps = placed_;
  commands.augmented = plan().augmented;
}

void PalpationTask::publishStatus(std::int64_t now_ns) {
  if (status().state == trial::TrialState::running) {
    shown_.lead_P = guidance_.lead(map_, listener_.seconds());
    if (guidance_.helps(status().trial)) shown_.levels = levelsOf(map_);
  }
  static_cast<trial::TrialStatus&>(shown_) = status();
  channels_.status_to_scene.publish(shown_, now_ns);
}

}  // namespace palpa::task_palpation
