#include <memory>

#include "anatomy/geometry/error.h"
#include "apps/cli/commands.h"
#include "apps/cli/output_folder.h"
#include "apps/cli/search_session.h"
#include "apps/cli/session_arguments.h"
#include "apps/cli/session_commands.h"
#include "apps/cli/session_records.h"

namespace palpa::cli {
namespace {

constexpr const char* kSearchExamples = R"(Examples:
  palpa search --operator expert --mode all --trials 8 --fast --out A
      a simulated person searches the same floors with full stiffness, with a fifth of it, and with that augmented; open A/report.html
  palpa search --operator novice --mode augmented --trials 20 --fast
      one mode alone
  palpa search --operator expert --mode augmented --blocks --fast
      the task's blocks: baseline, training in this mode, evaluation
  palpa search --station my_station.json --mode real --trials 20
      you, on a station with a haptic device and a "floor"
Three things lie hidden on a floor; one is rougher than the others. Find it, and stay in its middle. Keys: Enter start or go on, P pause, A abort, F1-F4 void, space EMERGENCY STOP, R re-arm, Escape leave.)";

}  // namespace

SessionLeft runSearchCommand(SessionOptions options) {
  settle(options);
  if (options.headset)
    throw UsageError("does not show a search yet", "--display openxr",
                     "Choose window or offscreen");
  const SearchWorld world(options);
  settleOperator(options, world.station);
  if (options.who == OperatorKind::person && world.onBench())
    throw UsageError(
        "cannot be felt with a mouse", "--operator person",
        "Give a station with a haptic device (--station), or take --operator expert or novice");
  checkTrainee(options);
  const std::filesystem::path folder = makeOutputFolder(options.out, options.command);
  const SearchRun run = runSearch(options, world, folder);
  writeSearchOutcome(options, world, run, folder);
  deliverSession(options, folder);
  return {folder, run.quit};
}

void addSearch(CLI::App& program) {
  const auto options = std::make_shared<SessionOptions>();
  options->command = "search";
  CLI::App* command = program.add_subcommand(
      "search", "A training session: find the rough one of three hidden things by touch");
  command->footer(kSearchExamples);
  command->add_option("--task", options->task, "Task file (default: the shipped one)")
      ->type_name("FILE");
  command
      ->add_option(
          "--mode", options->mode,
          "How the floor is rendered: as stiff as the device bears (real, the default), a fifth of "
          "that (degraded), that with cues added (augmented), or each episode in all three")
      ->check(CLI::IsMember({"real", "degraded", "augmented", "all"}))
      ->type_name("all|augmented|degraded|real");
  command->add_flag("--blocks", options->blocks,
                    "The task's blocks in place of --trials; training in the mode given");
  addRunArguments(*command, *options);
  command->callback([options] { runSearchCommand(*options); });
}

}  // namespace palpa::cli
