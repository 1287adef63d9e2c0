#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "anatomy/base/counted.h"
#include "anatomy/base/whole_file.h"
#include "apps/calibrate/procedure_proposal.h"
#include "apps/cli/commands.h"
#include "apps/cli/values.h"
#include "apps/evidence/expert_ranges.h"
#include "apps/runtime/clock.h"
#include "apps/session/output_folder.h"
#include "apps/station/assets.h"

namespace palpa::cli {
namespace {

constexpr const char* kProcedureExamples = R"(Examples:
  palpa calibrate procedures --from a/session.palpa b/session.palpa --out procedures.json
      the shipped library, its profiles made anew from these recordings
  PALPA=build/check/palpa bash assets/interactions/procedures.sh learn
      the shipped library, made again
What procedures there are, their cues, and what each task's labels mean stand in the library that
--library names; only profiles and durations are made of the recordings. Judge it by other ones.)";

struct ProcedureCommand {
  std::vector<std::string> from;
  std::string library, out = "procedures.json";
  std::uint64_t seed = 1;
};

std::filesystem::path libraryFile(const std::string& given) {
  return given.empty() ? station::assetFile("interactions/procedures.json")
                       : std::filesystem::path(given);
}

double secondsIn(const std::vector<calibrate::SubtaskRecordings>& recordings) {
  double steps = 0;
  for (const calibrate::SubtaskRecordings& r : recordings)
    for (const calibrate::SubtaskSequence& q : r.sequences)
      steps += static_cast<double>(q.labels.size());
  return 1e-9 * static_cast<double>(calibrate::kSubtaskStep_ns) * steps;
}

void calibrateProcedures(const ProcedureCommand& o) {
  using namespace calibrate;
  const std::vector<SubtaskRecordings> recordings =
      readRecordingsOfTasks({o.from.begin(), o.from.end()});
  calibration::ProcedureLibrary library =
      learnedFrom(calibration::readProcedures(libraryFile(o.library)), recordings, o.seed);
  library.made_by = "palpa calibrate procedures, from " + std::to_string(recordings.size()) +
                    " recordings, --seed " + std::to_string(o.seed);
  for (const SubtaskRecordings& r : recordings)
    library.simulated = library.simulated || r.simulated;
  calibration::writeProcedures(library, o.out);
  std::printf("Profiles of %zu procedures from %.0f s of %zu recordings%s\n",
              library.procedures.size(), secondsIn(recordings), recordings.size(),
              library.simulated ? " (SIMULATED)" : "");
  for (const std::string& sentence : wordsOf(propose(library, recordings)))
    std::printf("  On these recordings themselves: %s\n", sentence.c_str());
  std::printf("Written: %s\n", o.out.c_str());
}

}  // namespace

void proposeByLibrary(const std::vector<std::string>& recordings, const std::string& library,
                      const std::string& out) {
  using namespace calibrate;
  const ProcedureProposal proposal =
      propose(calibration::readProcedures(libraryFile(library)),
              readRecordingsOfTasks({recordings.begin(), recordings.end()}));
  session::OutputFolder output(out, "calibrate-subtasks");
  const std::filesystem::path& folder = output.path();
  writeWhole(folder / "procedures.json", toJson(proposal).dump(1) + "\n");
  writeProcedurePage(proposal, "palpa calibrate subtasks", runtime::utcNow(),
                     folder / "procedures.html");
  output.keep();
  std::printf("Parts by interactive procedures%s\n", proposal.simulated ? " (SIMULATED)" : "");
  for (std::size_t k = 0; k < proposal.shares.size(); ++k)
    if (proposal.shares[k].visits > 0)
      std::printf("  %-9s %4.1f %% of the time, %d times; cue: %s\n",
                  proposal.library.procedures[k].name.c_str(), 100 * proposal.shares[k].share,
                  proposal.shares[k].visits, proposal.library.procedures[k].cue.kind.c_str());
  for (const std::string& sentence : wordsOf(proposal)) std::printf("  %s\n", sentence.c_str());
  for (const TaskAgreement& task : proposal.tasks)
    if (proposal.tasks.size() > 1)
      std::printf("  %s: %s, %s\n", task.task.c_str(), agreementInShort(task.agreement).c_str(),
                  counted(task.recordings, "recording").c_str());
  std::printf("Written: %s\n", (folder / "procedures.html").c_str());
}

void addProcedureCalibration(CLI::App& calibrate) {
  CLI::App* command = calibrate.add_subcommand(
      "procedures", "The library of interactive procedures, its profiles from experts' recordings");
  command->footer(kProcedureExamples);
  const auto o = std::make_shared<ProcedureCommand>();
  command->add_option("--from", o->from, "Recorded sessions (session.palpa) of any tasks")
      ->required()
      ->type_name("FILE...");
  command
      ->add_option("--library", o->library,
                   "Library that names procedures, cues and labels; default: the shipped one")
      ->type_name("FILE");
  command->add_option("--seed", o->seed, "Seed of the fits' starts")->check(atLeastZero());
  command->add_option("--out", o->out, "File to write")->type_name("FILE");
  command->callback([o] { calibrateProcedures(*o); });
}

namespace {

constexpr const char* kRangeExamples = R"(Examples:
  palpa calibrate ranges --from out/expert-a/session.palpa out/expert-b/session.palpa
      what these experts reached, beside which a learner's report shows the learner
A task that is shipped finds its experts in assets/tasks/expert_ranges.json;
assets/tasks/expert_ranges.sh makes that file again, of simulated experts.)";

struct RangeOptions {
  std::vector<std::string> from;
  std::string out = "expert_ranges.json", made_by = "palpa calibrate ranges --from ...";
};

void calibrateRanges(const RangeOptions& o) {
  const auto ranges = evidence::expertRangesIn({o.from.begin(), o.from.end()});
  for (const auto& [task, group] : ranges)
    std::printf("%s: %s of %s%s\n", task.c_str(), counted(group.trials, "trial").c_str(),
                counted(group.people, "expert").c_str(), group.simulated ? " (simulated)" : "");
  evidence::writeExpertRanges(ranges, o.made_by, o.out);
  std::printf("Written: %s\n", o.out.c_str());
}

}  // namespace

void addExpertRanges(CLI::App& calibrate) {
  CLI::App* ranges = calibrate.add_subcommand(
      "ranges", "What experts reach, from their recorded sessions: shown beside learners' results");
  ranges->footer(kRangeExamples);
  const auto o = std::make_shared<RangeOptions>();
  ranges->add_option("--from", o->from, "Recorded sessions of experts")
      ->required()
      ->type_name("FILE...");
  ranges->add_option("--out", o->out, "File to write")->type_name("FILE");
  ranges->add_option("--made-by", o->made_by, "Noted in the file: how it is made again")
      ->type_name("TEXT");
  ranges->callback([o] { calibrateRanges(*o); });
}

}  // namespace palpa::cli
