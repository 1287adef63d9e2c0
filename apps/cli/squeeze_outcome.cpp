#include <cstdio>

#include "apps/assess/trial_role.h"
#include "apps/cli/session_facts.h"
#include "apps/cli/squeeze_session.h"
#include "apps/report/squeeze_report.h"

namespace palpa::cli {

void writeSqueezeOutcome(const SessionOptions& options, const SqueezeWorld& world,
                         const SqueezeRun& run, const std::filesystem::path& folder) {
  report::SqueezeReport page;
  std::vector<assess::SqueezeTrial> scored;
  for (const task_squeeze::CompletedSqueeze& trial : run.trials) {
    page.trials.push_back(trial.trial);
    if (assess::countsAsScored(trial.trial.role) && trial.trial.outcome != "void")
      scored.push_back(trial.trial);
  }
  report::writeSqueezeCsv(options.trainee, scored, folder / "trials.csv");
  page.title = world.task.title;
  page.trainee = whoPerformed(options);
  page.simulated = true;
  page.too_hard_N = world.task.too_hard;
  for (const trial::SavedPicture& p : run.pictures)
    page.pictures.push_back({p.file, p.moment.caption, p.moment.t_s});
  page.taxonomy = taxonomyFacts(world.task.taxonomy);
  page.station = stationFactsOf(options, world.station);
  page.station.push_back(surfaceFact(world.task.library));
  page.notes = runNotes(run);
  report::writeSqueezeReport(page, folder / "report.html");

  for (const task_squeeze::CompletedSqueeze& trial : run.trials)
    std::printf("Trial %d (%s, simulated): %s\n", trial.trial.trial, trial.trial.role.c_str(),
                trial.reason.empty() ? summaryOf(trial.trial).c_str() : trial.reason.c_str());
  std::printf("Written to %s:\n", folder.string().c_str());
  std::printf("  report.html     what was told apart, and how well: open this first\n");
  std::printf(
      "  trials.csv      one row a scored trial\n  session.palpa   the evidence: every tick of "
      "both tools, for replay\n");
  if (!run.pictures.empty())
    std::printf("  view-*.png      %zu pictures of the marked moments\n", run.pictures.size());
}

}  // namespace palpa::cli
