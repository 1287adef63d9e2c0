#include <cstdio>
#include <tuple>

#include "apps/assess/trial_role.h"
#include "apps/cli/palpation_session.h"
#include "apps/cli/session_facts.h"
#include "apps/report/palpation_report.h"

namespace palpa::cli {
namespace {

std::vector<report::PalpationPage> pagesOf(const PalpationWorld& world, const PalpationRun& run) {
  std::vector<report::PalpationPage> pages;
  for (const auto& trial : run.trials) {
    report::PalpationPage page{trial.assessment, trial.samples, world.task.scoring.rules, {}};
    for (const trial::SavedPicture& p : run.pictures)
      if (p.moment.trial == trial.assessment.facts.trial)
        page.pictures.push_back({p.file, p.moment.caption, p.moment.t_s});
    pages.push_back(std::move(page));
  }
  return pages;
}

std::vector<report::Fact> lumpFacts(const station::LumpLibrary& library) {
  std::vector<report::Fact> facts;
  for (const station::LumpKind& kind : library.kinds)
    facts.push_back({"Lump \"" + kind.name + "\"",
                     format("%.0f mm across, %.0f mm deep, %s", 1e3 * kind.diameter,
                            1e3 * kind.depth, kind.hardness == 1 ? "soft" : "hard"),
                     format("changes the force by %.0f %% where it is felt%s", 100 * kind.contrast,
                            library.simulated ? "; identified in simulated silicone" : "")});
  return facts;
}

}  // namespace

void writePalpationOutcome(const SessionOptions& options, const PalpationWorld& world,
                           const PalpationRun& run, const std::filesystem::path& folder) {
  std::vector<assess::PalpationAssessment> judged;
  for (const auto& trial : run.trials)
    if (trial.assessment.facts.outcome != "void" &&
        assess::countsAsScored(trial.assessment.facts.role))
      judged.push_back(trial.assessment);
  report::writePalpationCsv(options.trainee, judged, folder / "trials.csv");
  report::PalpationReport page;
  page.title = world.task.title;
  page.trainee = whoPerformed(options);
  page.simulated = world.simulated(options);
  page.force_note = world.forceNote();
  page.trials = pagesOf(world, run);
  page.standard = world.task.scoring.standard;
  page.taxonomy = taxonomyFacts(world.task.taxonomy);
  page.station = stationFactsOf(options, world.station);
  page.station.push_back(surfaceFact(world.task.library));
  for (report::Fact& fact : lumpFacts(world.task.library)) page.station.push_back(std::move(fact));
  page.notes = runNotes(run);
  page.parts = partsOf(world.task.augmentations, run.trials, [](const auto& t) {
    return std::tuple(t.assessment.doses, t.assessment.facts.augmented, t.assessment.score.seconds);
  });
  report::writePalpationReport(page, folder / "report.html");

  for (const auto& trial : run.trials) {
    const assess::PalpationAssessment& a = trial.assessment;
    std::printf("Trial %d (%s%s): %s\n", a.facts.trial, a.facts.role.c_str(),
                a.facts.simulated ? ", simulated" : "",
                trial.reason.empty() ? a.summary.c_str() : trial.reason.c_str());
  }
  std::printf("Written to %s:\n", folder.string().c_str());
  std::printf(
      "  report.html     what was found and felt, with reasons and pictures: open this first\n");
  std::printf(
      "  trials.csv      one row a scored trial\n  session.palpa   the evidence: every tick, for "
      "replay\n");
  if (run.video)
    std::printf(
        "  camera.mjpeg    the camera's %llu pictures; camera.mjpeg.csv: when each was exposed, "
        "and where the board was\n",
        static_cast<unsigned long long>(run.video->pictures));
  if (!run.pictures.empty())
    std::printf("  view-*.png      %zu pictures of the marked moments\n", run.pictures.size());
}

}  // namespace palpa::cli
