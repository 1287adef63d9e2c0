#include <cstdio>
#include <memory>

#include "apps/cli/study_analyse.h"
#include "apps/study_analysis/null_studies.h"

namespace palpa::cli {
namespace {

struct PlanOptions {
  study_analysis::DrawnStudies drawn;
  std::string metric = "total";
};

study_analysis::LearningModel modelOf(const std::vector<study_analysis::LearningModel>& all,
                                      const std::string& metric) {
  for (const study_analysis::LearningModel& m : all)
    if (m.metric == metric) return m;
  return all.front();
}

void printDetections(const char* what, const study_analysis::Detections& found) {
  const auto share = [&](int hits) { return 100.0 * hits / found.studies; };
  std::printf(
      "%s\n  experienced below novices, with force feedback: %5.1f %%  (as published: %5.1f %%)\n  "
      "novices learn, with force feedback:             %5.1f %%  (as published: %5.1f %%)\n",
      what, share(found.groups), share(found.groups_published), share(found.learning),
      share(found.learning_published));
}

void planStudy(const PlanOptions& o) {
  std::printf(
      "SIMULATED: %d studies drawn from a learning model, figure %s, %d subjects in each group and "
      "condition, %d trials each, level %g\n",
      o.drawn.studies, o.metric.c_str(), o.drawn.subjects, o.drawn.trials, o.drawn.level);
  printDetections("Studies that find the effects of Tzafestas 2008 (power):",
                  detectionsIn(modelOf(study_analysis::pilotModels(), o.metric), o.drawn));
  printDetections("Studies that find effects where there are none (false positives):",
                  detectionsIn(modelOf(study_analysis::nullModels(), o.metric), o.drawn));
  const study_analysis::Band band = study_analysis::binomialBand(o.drawn.studies, o.drawn.level);
  std::printf("A fair test has false positives between %.1f and %.1f %% here (95 %% band).\n",
              100.0 * band.low / o.drawn.studies, 100.0 * band.high / o.drawn.studies);
}

}  // namespace

void addStudyPlan(CLI::App& study) {
  CLI::App* command = study.add_subcommand(
      "plan", "How many subjects? Power and false positives of simulated studies");
  const auto o = std::make_shared<PlanOptions>();
  command
      ->add_option("--subjects", o->drawn.subjects,
                   "In each group and condition (default 5, as in the paper)")
      ->check(CLI::Range(2, 1000));
  command->add_option("--trials", o->drawn.trials, "Of each subject (default 10)")
      ->check(CLI::Range(4, 1000));
  command->add_option("--simulate", o->drawn.studies, "Studies to draw (default 2000)")
      ->check(CLI::Range(1, 1000000));
  command->add_option("--level", o->drawn.level, "Level of each test (default 0.05)")
      ->check(CLI::Range(0.0001, 0.5));
  command->add_option("--metric", o->metric, "total (default) or time_s")
      ->check(CLI::IsMember({"total", "time_s"}));
  command->add_option("--seed", o->drawn.seed, "Random seed (default 1)");
  command->footer("Example:\n  palpa study plan --subjects 12 --simulate 2000");
  command->callback([o] { planStudy(*o); });
}

}  // namespace palpa::cli
