#include "apps/cli/study_analyse.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "anatomy/geometry/error.h"
#include "apps/cli/output_folder.h"
#include "apps/cli/records_place.h"
#include "apps/cli/study_source.h"
#include "apps/report/study_report.h"

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
    ProtocolFacts facts = protocolFacts(o.protocol);
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
    input.rows = studyRowsOfFile(o.csv);
    input.sources.push_back({"Table", fs::path(o.csv).filename().string(), ""});
    return input;
  }
  record::RecordStore store(o.records.empty() ? usualRecords() : o.records);
  input.rows = studyRows(store, study);
  input.sources.push_back({"Study in the records", study, ""});
  return input;
}

using study_analysis::StudyRow;

/// A name mistyped would leave its rows out of every table.
template <class NameOf>
void requireNames(const std::vector<std::string>& names, const std::vector<StudyRow>& rows,
                  const char* option, NameOf nameOf) {
  for (const std::string& name : names)
    if (std::none_of(rows.begin(), rows.end(),
                     [&](const StudyRow& row) { return nameOf(row) == name; }))
      throw UsageError("is in no trial of this study", std::string(option) + " " + name,
                       "Write it as the protocol or the table does");
}

void analyse(const AnalyseOptions& o) {
  if (o.protocol.empty() && o.study.empty() && o.csv.empty())
    throw UsageError("needs --protocol, --study or --csv", "palpa study analyse",
                     "Say what is to be analysed");
  AnalyseInput input = inputOf(o);
  requireNames(o.groups, input.rows, "--groups", [](const StudyRow& row) { return row.group; });
  requireNames(o.conditions, input.rows, "--conditions",
               [](const StudyRow& row) { return row.condition; });
  const study_analysis::StudyResult result = study_analysis::analyseStudy(input.rows, input.design);
  const fs::path folder = makeOutputFolder(o.out, "study");
  const std::vector<fs::path> files = report::writeStudyTables(result, folder);
  report::writeStudyReport({result, input.sources}, folder / "report.html");
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
      ->type_name("FILE");
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
  command->add_flag(
      "--as-published", o->as_published,
      "Beside: the paper's way, trials taken as independent, and why not to trust it");
  command->add_option("--out", o->out, "Folder for the results; default: out/study-<time>")
      ->type_name("FOLDER");
  command->footer(
      "Examples:\n  palpa study analyse --protocol assets/protocols/paracentesis_pilot.json "
      "--as-published\n  palpa study analyse --csv trials.csv --kind \"search study\" --out A");
  command->callback([o] { analyse(*o); });
}

}  // namespace palpa::cli
