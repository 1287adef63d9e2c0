#include "apps/session/pulse_session.h"

#include <cmath>
#include <cstdio>
#include <memory>

#include "anatomy/parametric/phantoms.h"
#include "apps/report/pulse/pulse_report.h"
#include "apps/runtime/clock.h"
#include "apps/session/output_folder.h"
#include "apps/station/assets.h"
#include "apps/task_pulse/pulse_scene.h"
#include "apps/training/trial_words.h"
#include "apps/twin/feeling_hands.h"

namespace palpa::session {

PulseWorld::PulseWorld(const SessionOptions& options)
    : station(feelingStation(options)),
      task(task_pulse::readPulse(options.task.empty() ? station::assetFile("tasks/pulse.json")
                                                      : std::filesystem::path(options.task))),
      object(anatomy::phantomBlock(task.size, task.title)),
      X_WA(station.sample->X_WP * anatomy::X_AP().inverse()) {
  task.library = libraryOn(options, station, std::move(task.library));
  if (std::abs(station.sample->tip_radius - task.library.tip_radius) > 1e-6)
    station.file.refuse("sample/tip_radius_mm",
                        "is not that of the tip with which the silicone was identified");
}

haptics::TickConfig PulseWorld::tickConfig(const SessionOptions& options) const {
  haptics::TickConfig tick = sensedTick(options, station, task.library);
  tick.pulse = task.law;
  return tick;
}

SessionDevices::Hands PulseWorld::hands(const SessionOptions& options) const {
  const twin::PulseSkill skill = twin::readPulseSkill(operatorFile(options, "pulse_"));
  return SessionDevices::overSilicone(
      options, station, twin::pulseHand(skill, anatomy::X_AP(), station.X_ET, options.seed),
      station.sample->X_WP, task.library.tip_radius);
}

record::SessionInfo PulseWorld::info(const SessionOptions& options) const {
  record::SessionInfo info = infoOf(options, head(options), task.source);
  info.station_json = station.file.json().dump();
  info.tick_config = tickConfig(options);
  return info;
}

ReportHead PulseWorld::head(const SessionOptions& options) const {
  ReportHead head = headOf(options, task.title, task.taxonomy, station, simulated(options));
  head.too_hard_N = task.rules.too_hard_N;
  head.station.push_back(surfaceFact(task.library));
  return head;
}

PulseRun runPulse(const SessionOptions& options, const PulseWorld& world,
                  const std::filesystem::path& folder) {
  task_pulse::PulseChannels channels(options.fast ? runtime::TimeMode::virtual_time
                                                  : runtime::TimeMode::real);
  const haptics::TickConfig tick = world.tickConfig(options);
  SessionFrame frame(
      options,
      {training::Engine::pulse, world.station, world.object, world.X_WA, tick, std::nullopt, false},
      world.hands(options), channels, folder);
  const std::string not_scored = world.station.calibrationProblem();
  task_pulse::PulseTask task(
      {.settings = world.task,
       .tick = tick,
       .simulated = world.simulated(options),
       .automatic = options.who != OperatorKind::person,
       .force_feedback = options.force_feedback,
       .not_scored = not_scored,
       .seed = options.seed,
       .cases = task_pulse::casesOf(world.task, options.seed, options.trials),
       .places = frame.places(),
       .role = options.role},
      frame.bus(), channels, frame.executive());
  task_pulse::PulseScene scene({frame.stage(), anatomy::X_AP()}, frame.bus(), channels);
  PulseRun run;
  task.isFor(world.task.brief);
  static_cast<SessionRun&>(run) = frame.run(task, scene, world.info(options));
  run.trials = task.completed();
  return run;
}

void writePulseResults(const ReportHead& head,
                       const std::vector<task_pulse::CompletedPulse>& trials,
                       const assess::PulseRules& rules, const ReportTail& tail,
                       const std::filesystem::path& evidence) {
  report::PulseReport page;
  page.rules = rules;
  for (const task_pulse::CompletedPulse& trial : trials) page.trials.push_back(trial.trial);
  const std::filesystem::path folder = evidence.parent_path();
  report::writePulseCsv(head.user_id, page.trials, rules, folder / "trials.csv");
  if (!head.page) return;
  static_cast<report::SessionPage&>(page) =
      pageOf(head, tail, evidence, training::Engine::pulse, judgedOf(trials, [&](const auto& t) {
               return progress::JudgedTrial{t.trial.role, t.trial.outcome,
                                            assess::pulseMetrics(t.trial, rules)};
             }));
  page.pictures = picturesOf(tail);
  report::writePulseReport(page, folder / "report.html");
}

void writePulseOutcome(const SessionOptions& options, const PulseWorld& world, const PulseRun& run,
                       const std::filesystem::path& folder) {
  const assess::PulseRules& rules = world.task.rules;
  writePulseResults(world.head(options), run.trials, rules, {run.pictures, runNotes(run)},
                    folder / "session.palpa");
  for (const task_pulse::CompletedPulse& trial : run.trials)
    std::printf(
        "Trial %d (%s%s): %s\n", trial.trial.trial, training::nameOf(trial.trial.role).c_str(),
        trial.trial.simulated ? ", simulated" : "",
        trial.reason.empty() ? summaryOf(trial.trial, rules).c_str() : trial.reason.c_str());
  if (options.report) sayWritten(run, folder, "what was found, counted and told", "scored trial");
}

}  // namespace palpa::session
