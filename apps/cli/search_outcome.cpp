#include <cstdio>

#include "apps/cli/search_session.h"
#include "apps/cli/session_facts.h"
#include "apps/report/search_report.h"

namespace palpa::cli {

void writeSearchOutcome(const SessionOptions& options, const SearchWorld& world,
                        const SearchRun& run, const std::filesystem::path& folder) {
  report::SearchReport page;
  std::vector<assess::SearchTrial> written;
  for (const task_search::CompletedSearch& trial : run.trials) {
    page.trials.push_back(trial.trial);
    if (counts(trial.trial)) written.push_back(trial.trial);
  }
  report::writeSearchCsv(options.trainee, written, folder / "trials.csv");
  page.title = world.task.title;
  page.trainee = whoPerformed(options);
  page.simulated = world.simulated(options);
  for (const station::NamedPlan::Part& part : world.task.augmentations.subtasks)
    page.subtasks.push_back({part.name, part.means});
  for (const trial::SavedPicture& p : run.pictures)
    page.pictures.push_back({p.file, p.moment.caption, p.moment.t_s});
  page.taxonomy = taxonomyFacts(world.task.taxonomy);
  page.station = stationFactsOf(options, world.station);
  page.station.push_back({"Stiffness of the floor",
                          format("%.0f N/m, degraded %.0f N/m", world.rendering.real.stiffness,
                                 world.rendering.degraded.stiffness),
                          ""});
  page.notes = runNotes(run);
  page.unit_note =
      format("1 U = %.3g mm in the hand: the floor is %.1f mm wide", 1e3 * world.rendering.unit,
             1e3 * world.rendering.unit * world.task.spec.side);
  report::writeSearchReport(page, folder / "report.html");

  const char* simulated = page.simulated ? ", simulated" : "";
  for (const task_search::CompletedSearch& trial : run.trials)
    std::printf("Episode %d (%s, %s%s): %s\n", trial.trial.trial, name(trial.trial.mode),
                trial.trial.role.c_str(), simulated,
                trial.reason.empty() ? summaryOf(trial.trial).c_str() : trial.reason.c_str());
  for (const assess::SearchTally& tally : assess::talliesOf(page.trials))
    std::printf("%s%s%s: found in %d of %d episodes\n", tally.block.c_str(),
                tally.block.empty() ? "" : ", ", name(tally.mode), tally.found, tally.episodes);
  std::printf("Written to %s:\n", folder.string().c_str());
  std::printf("  report.html     how often and how fast the target was found: open this first\n");
  std::printf(
      "  trials.csv      one row a scored episode\n  session.palpa   the evidence: every tick, for "
      "replay\n");
  if (!run.pictures.empty())
    std::printf("  view-*.png      %zu pictures of the marked moments\n", run.pictures.size());
}

}  // namespace palpa::cli
