#include "anatomy/base/json_file.h"
#include "apps/evidence/recorded_show.h"
#include "apps/training/engine.h"

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "anatomy/parametric/phantoms.h"
#include "apps/evidence/recorded_trials.h"
#include "apps/replay/touch_replay.h"
#include "apps/task_palpation/palpation_place.h"
#include "apps/task_palpation/palpation_scene.h"

namespace palpa::evidence {

using runtime::EventKind;
using training::Engine;

namespace {

constexpr double kPlateThick = 0.02;  // m, of the floor as shown

/// Events worth a mark, in the trial's time: what the judge's clock leaves out, pauses, is left out
/// here, too.
class Marks {
 public:
  Marks(const record::SessionReader& reader, int trial) {
    for (const runtime::Event& event : reader.events())
      if (event.trial == trial && toneOf(event)) events_.push_back(event);
  }
  /// Ticks in their order, with the trial's time after each.
  void pass(std::int64_t t_ns, double t_s) {
    for (; next_ < events_.size() && events_[next_].t_ns <= t_ns; ++next_)
      marks_.push_back({t_s, *toneOf(events_[next_]), events_[next_].text});
  }
  const std::vector<replay::StripMark>& marks() const { return marks_; }

 private:
  static std::optional<scene::TickTone> toneOf(const runtime::Event& event) {
    if (event.is(EventKind::safety) || event.is(EventKind::emergency_stop))
      return scene::TickTone::bad;
    if (event.is(EventKind::mark) || event.is(EventKind::let_go) || event.is(EventKind::thing) ||
        event.is(EventKind::answer) || event.is(EventKind::phase))
      return scene::TickTone::guide;
    if (event.is(EventKind::pause) || event.is(EventKind::resume)) return scene::TickTone::neutral;
    return std::nullopt;
  }

  std::vector<runtime::Event> events_;
  std::size_t next_ = 0;
  std::vector<replay::StripMark> marks_;
};

/// What the three have in common: the trial, what is shown, the ticks.
template <class Trial>
class TouchShow : public RecordedShow {
 public:
  const anatomy::Patient& patient() const override { return *shown_; }
  double length_s() const override { return trial_.length_s(); }
  const std::vector<replay::StripMark>& marks() const override { return trial_.marks; }

 protected:
  TouchShow(const std::filesystem::path& file, int number)
      : reader_(file),
        recorded_(chosenTrial(trials_ = reader_.trials(), file, number)),
        marks_(reader_, recorded_.header.trial),
        file_(file.string()) {
    trial_.number = recorded_.header.trial;
    trial_.force_feedback = recorded_.header.force_feedback;
    trial_.mark = JsonFile::ofText(reader_.info().session_json, "the recorded session")
                          .flag("simulated", true)
                      ? "REPLAY: SIMULATED"
                      : "REPLAY";
  }

  const haptics::TickConfig& config() const { return reader_.info().tick_config; }
  JsonFile task() const { return JsonFile::ofText(reader_.info().task_json, "the recorded task"); }
  std::string eventText(EventKind kind) const {
    for (const runtime::Event& event : reader_.events())
      if (event.trial == trial_.number && event.is(kind)) return event.text;
    throw Error("does not describe its \"" + nameOf(kind) + '"',
                file_ + ", trial " + std::to_string(trial_.number),
                "Restore the file from a backup");
  }
  /// Hands the trial's ticks to a reader; `seconds` tells the trial's time.
  template <class Reader, class Seconds>
  void receive(Reader& reader, Seconds seconds) {
    reader_.ticks([&](const haptics::FlightRecord& record) {
      if (recorded_.isOver(record.t_ns)) return;
      reader.add(record);
      if (record.commands.trial == static_cast<std::uint32_t>(trial_.number))
        marks_.pass(record.t_ns, seconds());
    });
    trial_.marks = marks_.marks();
  }
  void need(bool ticks) const {
    if (!ticks)
      throw Error("has no ticks of trial " + std::to_string(trial_.number), file_,
                  "The program stopped before it began");
  }

  record::SessionReader reader_;
  std::vector<record::RecordedTrial> trials_;
  const record::RecordedTrial& recorded_;
  Marks marks_;
  std::string file_;
  std::optional<anatomy::Patient> shown_;
  Trial trial_;
};

template <class Moments>
double lastOf(const Moments& moments) {
  return moments.empty() ? 0 : moments.back().t_s;
}

class PalpationShow final : public TouchShow<replay::PalpationTrial> {
 public:
  PalpationShow(const std::filesystem::path& file, int number) : TouchShow(file, number) {
    const JsonFile json = task();
    trial_.X_AD = anatomy::X_AP() * unpack(config().X_DP).inverse();
    trial_.rules = task_palpation::scoringOf(json).rules;
    trial_.tip_radius = config().touch.tip_radius;
    shown_ = task_palpation::shownPhantom(task_palpation::sizeOf(json), "phantom",
                                          trial_.rules.area, task_palpation::seenAs(json));
    const std::optional<haptics::PairConfig>& pair = reader_.info().pair_config;
    if (pair) trial_.X_AD2 = anatomy::X_AP() * unpack(pair->tools[1].X_DP).inverse();
    trial_.estimated = pair && pair->estimated;
    const nlohmann::json session = parseJson(reader_.info().session_json);
    if (session.contains("map"))
      trial_.map =
          task_palpation::shownMap(station::mappedObjectIn(session["map"]), anatomy::X_AP());
    replay::PalpationReader reader(config(), pair, trial_.number);
    receive(reader, [&] { return reader.seconds(); });
    reader.into(trial_);
    need(!trial_.moments.empty());
    showLumps();
  }
  std::unique_ptr<replay::TrialReplay> on(scene::SceneView& view) override {
    return replay::palpationReplay(trial_, view);
  }
  void hideMap() override { trial_.map.reset(); }

 private:
  /// What lay inside, and whether it was found.
  void showLumps() {
    for (const RecordedPalpation& one : recordedPalpations(reader_)) {
      if (one.recorded.header.trial != trial_.number) continue;
      const std::vector<assess::CaseLump> lumps =
          task_palpation::caseOf(eventText(EventKind::trial_case));
      for (std::size_t i = 0; i < lumps.size(); ++i)
        trial_.lumps.push_back(
            {fromTop(config().top, lumps[i].p_P), lumps[i].diameter / 2,
             i < one.assessment.score.lumps.size() && one.assessment.score.lumps[i].mark >= 0,
             false});
    }
  }
};

class SearchShow final : public TouchShow<replay::ShownSearch> {
 public:
  SearchShow(const std::filesystem::path& file, int number) : TouchShow(file, number) {
    const task_search::SearchSettings settings = task_search::readSearch(task());
    const double unit = config().floor.unit;
    trial_.X_AD = anatomy::X_AP() * unpack(config().X_DF).inverse();
    trial_.side = settings.spec.side * unit;
    trial_.magnification = settings.shown_per_U / unit;
    const double side = settings.spec.side * settings.shown_per_U;
    shown_ = anatomy::phantomBlock({side, side, kPlateThick}, settings.title);
    replay::SearchReader reader(settings, config(), trial_.number);
    receive(reader, [&] { return lastOf(reader.moments()); });
    trial_.moments = reader.moments();
    need(!trial_.moments.empty());
  }
  std::unique_ptr<replay::TrialReplay> on(scene::SceneView& view) override {
    return replay::searchReplay(trial_, view);
  }
};

class PulseShow final : public TouchShow<replay::ShownPulse> {
 public:
  PulseShow(const std::filesystem::path& file, int number) : TouchShow(file, number) {
    const JsonFile json = task();
    trial_.X_AD = anatomy::X_AP() * unpack(config().X_DP).inverse();
    trial_.patient = task_pulse::caseIn(eventText(EventKind::trial_case));
    shown_ = anatomy::phantomBlock(1e-3 * Vec3(json.number("phantom/across_mm", 10, 500),
                                               json.number("phantom/away_mm", 10, 500),
                                               json.number("phantom/high_mm", 5, 300)),
                                   "phantom");
    replay::PulseReader reader(config(), task_pulse::rulesIn(json), trial_.number);
    receive(reader, [&] { return lastOf(reader.moments()); });
    trial_.moments = reader.moments();
    need(!trial_.moments.empty());
  }
  std::unique_ptr<replay::TrialReplay> on(scene::SceneView& view) override {
    return replay::pulseReplay(trial_, view);
  }
};

/// Something held by two tools, or stroked by one.
class ComparisonShow final : public TouchShow<replay::ShownComparison> {
 public:
  ComparisonShow(const std::filesystem::path& file, int number, Engine engine)
      : TouchShow(file, number) {
    const JsonFile json = task();
    std::vector<Pose> X_ET{unpack(config().X_ET)};
    trial_.X_AD = anatomy::X_AP() * unpack(config().X_DP).inverse();
    trial_.up_A = anatomy::X_AP().linear() * Vec3::UnitZ();
    trial_.comparison = task_comparison::comparisonIn(eventText(EventKind::trial_case));
    if (engine == Engine::squeeze) {
      X_ET.push_back(secondTool());
      showHeld(1e-3 * json.number("object/half_mm", 10, 100));
    } else {
      shown_ = anatomy::phantomBlock(1e-3 * Vec3(json.number("phantom/across_mm", 10, 500),
                                                 json.number("phantom/away_mm", 10, 500),
                                                 json.number("phantom/high_mm", 5, 300)),
                                     "phantom");
    }
    replay::ComparisonReader reader(json.number("force/touch_N", 0.02, 5), X_ET, trial_.comparison,
                                    trial_.number);
    receive(reader, [&] { return lastOf(reader.moments()); });
    trial_.moments = reader.moments();
    need(!trial_.moments.empty());
  }
  std::unique_ptr<replay::TrialReplay> on(scene::SceneView& view) override {
    return replay::comparisonReplay(trial_, view);
  }

 private:
  /// X_ET of the second tool; its base into the trial.
  Pose secondTool() {
    if (!reader_.info().pair_config)
      throw Error("describes one device where two are needed", file_,
                  "Restore the file from a backup");
    const haptics::TickConfig& tool = reader_.info().pair_config->tools[1];
    trial_.X_AD2 = anatomy::X_AP() * unpack(tool.X_DP).inverse();
    return unpack(tool.X_ET);
  }
  void showHeld(double half) {
    trial_.middle_A = anatomy::X_AP() * Vec3(0, 0, -half);
    shown_ = anatomy::phantomBlock(Vec3::Constant(2 * half), "object");
  }
};

}  // namespace

std::unique_ptr<RecordedShow> recordedTouch(const std::filesystem::path& file, Engine engine,
                                            int number) {
  if (engine == Engine::palpation) return std::make_unique<PalpationShow>(file, number);
  if (engine == Engine::search) return std::make_unique<SearchShow>(file, number);
  if (engine == Engine::pulse) return std::make_unique<PulseShow>(file, number);
  return std::make_unique<ComparisonShow>(file, number, engine);
}

}  // namespace palpa::evidence
