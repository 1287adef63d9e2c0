#include <filesystem>
#include <memory>

#include "anatomy/base/error.h"
#include "apps/cli/arguments.h"
#include "apps/cli/commands.h"
#include "apps/cli/values.h"
#include "apps/record/store/record_store.h"
#include "apps/study/run/study_run.h"

namespace palpa::cli {
namespace {

constexpr const char* kRunExamples = R"(Examples:
  palpa records trainee add --id T001 --group novice --consent --research
  palpa study run --protocol assets/protocols/paracentesis_pilot.json --trainee T001
      enrols, draws the condition, leads through the session; after an interruption the same command continues
  palpa study run --protocol assets/protocols/paracentesis_pilot.json --trainee T001 --answers answers.json
      takes the questionnaire's answers from a file: {"useful": 4, "remarks": "..."}
  palpa study run --protocol assets/protocols/paracentesis_pilot.json --simulate --learning assets/protocols/learners/paracentesis_learners.json --records cohort.sqlite
      virtual trainees who learn, to test the whole chain; marked as simulated;
      --tracking model saves a third of the time)";

/// Notes of this station name the records; they must mean the same from any folder.
std::string fromAnywhere(const std::string& url) {
  record::requireAddress(url);
  return record::isServer(url) ? url : std::filesystem::absolute(url).string();
}

void run(study::StudyOptions o) {
  o.url = fromAnywhere(o.url);
  if (o.simulate) {
    if (!o.trainee.empty())
      throw UsageError("exclude each other", "--trainee, --simulate", "Leave one of them out");
    if (o.learners.empty())
      throw UsageError("needs --learning, which says how they learn", "--simulate",
                       "E.g. --learning assets/protocols/learners/paracentesis_learners.json");
    return study::simulateStudy(o);
  }
  if (o.trainee.empty())
    throw UsageError("needs --trainee or --simulate", "palpa study run", "See its --help");
  if (!o.learners.empty())
    throw UsageError("goes with --simulate only", "--learning", "Leave it out, or add --simulate");
  study::runStudySession(o);
}

void addProtocol(CLI::App& command, study::StudyOptions& o) {
  command.add_option("--protocol", o.protocol, "Protocol file")
      ->required()
      ->type_name("FILE")
      ->check(somethingThere("protocols"));
  addRecordsArgument(command, o.url);
}

void addRun(CLI::App& study) {
  const auto o = std::make_shared<study::StudyOptions>();
  CLI::App* command = study.add_subcommand(
      "run", "Lead a trainee through the next session of a protocol; or simulate virtual trainees");
  command->footer(kRunExamples);
  addProtocol(*command, *o);
  command->add_option("--trainee", o->trainee, "Pseudonym, as in the records")
      ->check(record::whyNoPseudonym);
  command
      ->add_option("--answers", o->answers,
                   "Answers to the questionnaire; default: they are asked for")
      ->type_name("FILE");
  command
      ->add_option("--seed", o->seed,
                   "Seed of the study, if it begins with this trainee (default: drawn and kept in "
                   "the records; 1 for virtual trainees)")
      ->check(moreThanZero());
  CLI::Option* simulate =
      command
          ->add_option(
              "--simulate", o->subjects,
              "Number of virtual trainees in each group (default: as in the learners' file)")
          ->expected(0, 1)
          ->check(inRange(0, 1000));
  command->add_option("--learning", o->learners, "How virtual trainees learn")
      ->type_name("FILE")
      ->check(somethingThere("protocols/learners"));
  command
      ->add_option("--workers", o->workers,
                   "Processes for virtual trainees (default 2); changes no result")
      ->check(inRange(1, 64));
  addPlaceArguments(*command, o->session);
  command->callback([o, simulate] {
    o->simulate = simulate->count() > 0;
    run(*o);
  });
}

}  // namespace

void addStudy(CLI::App& program) {
  CLI::App* study = program.add_subcommand(
      "study",
      "Studies: run a protocol, see how far it is, what was found, how many subjects it takes");
  study->require_subcommand(1);
  study->footer(
      "Examples:\n  palpa study run --protocol assets/protocols/paracentesis_pilot.json --trainee "
      "T001\n  palpa study status --protocol assets/protocols/paracentesis_pilot.json");
  addRun(*study);
  const auto o = std::make_shared<study::StudyOptions>();
  CLI::App* status = study->add_subcommand(
      "status", "Who is enrolled, who is next, how far everybody is; never a condition");
  status->footer(
      "Example:\n  palpa study status --protocol assets/protocols/paracentesis_pilot.json");
  addProtocol(*status, *o);
  status->callback([o] { study::reportStudy(*o); });
  addStudyAnalyse(*study);
  addStudyPlan(*study);
}

}  // namespace palpa::cli
