#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "anatomy/base/nearest_word.h"
#include "apps/cli/arguments.h"
#include "apps/cli/commands.h"
#include "apps/cli/values.h"
#include "apps/report/study/study_report.h"
#include "apps/session/output_folder.h"
#include "apps/study/analysis/power_analysis.h"
#include "apps/study/run/study_run.h"

namespace palpa::cli {
namespace {

namespace fs = std::filesystem;

struct AnalyseOptions {
  std::string protocol, study, csv, kind, records, out;
  std::vector<std::string> groups, conditions, metrics;
  bool as_published = false;
};

struct AnalyseInput {
  study_analysis::StudyDesign design;
  std::vector<study_analysis::StudyRow> rows;
  std::vector<report::Fact> sources;
};

/// What the command line says goes before what the protocol says.
study_analysis::StudyDesign designOf(const AnalyseOptions& o, std::string& study) {
  study_analysis::StudyDesign design;
  if (!o.protocol.empty()) {
    study::ProtocolFacts facts = study::protocolFacts(o.protocol);
    design = std::move(facts.design);
    if (study.empty()) study = facts.id;
  } else {
    design.title = "Study " + (study.empty() ? fs::path(o.csv).stem().string() : study);
  }
  if (!o.kind.empty()) design.kind = study_analysis::studyKindNamed(o.kind, "--kind");
  if (!o.groups.empty()) design.groups = o.groups;
  if (!o.conditions.empty()) design.conditions = o.conditions;
  design.metrics = o.metrics;
  design.as_published = o.as_published;
  return design;
}

AnalyseInput inputOf(const AnalyseOptions& o) {
  AnalyseInput input;
  std::string study = o.study;
  input.design = designOf(o, study);
  if (!o.protocol.empty())
    input.sources.push_back({"Protocol", fs::path(o.protocol).filename().string(), ""});
  if (!o.csv.empty()) {
    input.rows = study::studyRowsOfFile(o.csv);
    input.sources.push_back({"Table", fs::path(o.csv).filename().string(), ""});
    return input;
  }
  record::RecordStore store(o.records.empty() ? usualRecords() : o.records);
  input.rows = study::studyRows(store, study);
  input.sources.push_back({"Study in the records", study, ""});
  return input;
}

using study_analysis::StudyRow;

/// A name mistyped would leave its rows out of every table.
template <class NameOf>
void requireNames(const std::vector<std::string>& names, const std::vector<StudyRow>& rows,
                  const char* option, NameOf nameOf) {
  std::set<std::string> there;
  for (const StudyRow& row : rows) there.insert(nameOf(row));
  const std::vector<std::string> known(there.begin(), there.end());
  for (const std::string& name : names)
    if (there.count(name) == 0)
      throw UsageError("is in no trial of this study" + didYouMean(name, known),
                       std::string(option) + " " + name, "There are: " + listed(known, "and"));
}

void analyse(const AnalyseOptions& o) {
  if (o.protocol.empty() && o.study.empty() && o.csv.empty())
    throw UsageError("needs --protocol, --study or --csv", "palpa study analyse",
                     "Say what to analyse");
  AnalyseInput input = inputOf(o);
  requireNames(o.groups, input.rows, "--groups", [](const StudyRow& row) { return row.group; });
  requireNames(o.conditions, input.rows, "--conditions",
               [](const StudyRow& row) { return row.condition; });
  const study_analysis::StudyResult result = study_analysis::analyseStudy(input.rows, input.design);
  session::OutputFolder output(o.out, "study");
  const fs::path& folder = output.path();
  const std::vector<fs::path> files = report::writeStudyTables(result, folder);
  report::writeStudyReport({result, input.sources}, folder / "report.html");
  output.keep();
  if (result.simulated_trials > 0)
    std::printf("SIMULATED: %zu of %zu trials\n", result.simulated_trials, result.trials);
  for (const std::string& finding : result.findings) std::printf("%s\n", finding.c_str());
  std::printf("Written: %s\n", (folder / "report.html").string().c_str());
  for (const fs::path& file : files) std::printf("Written: %s\n", file.string().c_str());
}

}  // namespace

void addStudyAnalyse(CLI::App& study) {
  CLI::App* command = study.add_subcommand(
      "analyse", "Tables, figures and a page of a study, each subject counted once");
  const auto o = std::make_shared<AnalyseOptions>();
  command
      ->add_option("--protocol", o->protocol,
                   "The study's protocol: id, groups, conditions, kind of analysis")
      ->type_name("FILE")
      ->check(somethingThere("protocols"));
  command->add_option("--study", o->study, "The study's id in the records; default: the protocol's")
      ->type_name("ID");
  addRecordsArgument(*command, o->records);
  command
      ->add_option("--csv", o->csv,
                   "Instead of records: a table SUBJECT,GROUP,CONDITION,BLOCK,TRIAL and figures")
      ->type_name("FILE");
  command
      ->add_option("--kind", o->kind,
                   "general, \"paracentesis pilot\" or \"search study\"; default: the protocol's "
                   "field analysis, else general")
      ->type_name("KIND");
  command
      ->add_option(
          "--groups", o->groups,
          "Order of the groups, the learners first; default: the protocol's, else as they appear")
      ->delimiter(',')
      ->type_name("NAME,...");
  command->add_option("--conditions", o->conditions, "Order of the conditions")
      ->delimiter(',')
      ->type_name("NAME,...");
  command
      ->add_option("--metrics", o->metrics, "Figures of a general analysis; default: all that vary")
      ->delimiter(',')
      ->type_name("NAME,...");
  command->add_flag("--as-published", o->as_published,
                    "Also the published way: trials taken as independent, and why not to trust it");
  command->add_option("--out", o->out, "Folder for the results; default: out/study-<time>")
      ->type_name("FOLDER");
  command->footer(
      "Examples:\n  palpa study analyse --protocol assets/protocols/paracentesis_pilot.json "
      "--as-published\n  palpa study analyse --csv trials.csv --kind \"search study\" --out A");
  command->callback([o] { analyse(*o); });
}

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
      "condition, %s each, level %g\n",
      o.drawn.studies, o.metric.c_str(), o.drawn.subjects, counted(o.drawn.trials, "trial").c_str(),
      o.drawn.level);
  printDetections("Studies that find the effects of Tzafestas 2008 (power):",
                  detectionsIn(modelOf(study_analysis::pilotModels(), o.metric), o.drawn));
  printDetections("Studies that find effects where there is none (false positives):",
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
                   "Subjects in each group and condition (default 5, as in the published pilot)")
      ->check(inRange(2, 1000));
  command->add_option("--trials", o->drawn.trials, "Trials of each subject (default 10)")
      ->check(inRange(4, 1000));
  command->add_option("--simulate", o->drawn.studies, "Studies to draw (default 2000)")
      ->check(inRange(1, 1000000));
  command->add_option("--level", o->drawn.level, "Level of each test (default 0.05)")
      ->check(inRange(0.0001, 0.5));
  command->add_option("--metric", o->metric, "total (default) or time_s")
      ->check(oneOf({"total", "time_s"}));
  command->add_option("--seed", o->drawn.seed, "Random seed (default 1)")->check(atLeastZero());
  command->footer("Example:\n  palpa study plan --subjects 12 --simulate 2000");
  command->callback([o] { planStudy(*o); });
}

}  // namespace palpa::cli
