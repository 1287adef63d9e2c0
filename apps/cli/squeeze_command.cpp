#include <memory>

#include "anatomy/geometry/error.h"
#include "apps/cli/commands.h"
#include "apps/cli/output_folder.h"
#include "apps/cli/session_arguments.h"
#include "apps/cli/session_commands.h"
#include "apps/cli/session_records.h"
#include "apps/cli/squeeze_session.h"

namespace palpa::cli {
namespace {

constexpr const char* kSqueezeExamples = R"(Examples:
  palpa squeeze --operator expert --fast --trials 16 --out A
      a simulated person compares two things in the hand, one after the other; open A/report.html
  palpa squeeze --operator novice --fast --trials 16 --force-feedback off
      the same without force feedback: both feel alike, and the answers are guesses
Two devices are simulated only, so far: a person cannot take part yet.)";

}  // namespace

SessionLeft runSqueezeCommand(SessionOptions options) {
  settle(options);
  if (!isSimulated(options.who))
    throw UsageError("cannot hold something with one device", "--operator",
                     "Two devices are simulated only, so far: --operator expert or novice");
  if (options.headset)
    throw UsageError("does not show squeezing yet", "--display openxr",
                     "Choose window or offscreen");
  const SqueezeWorld world(options);
  checkTrainee(options);
  const std::filesystem::path folder = makeOutputFolder(options.out, options.command);
  const SqueezeRun run = runSqueeze(options, world, folder);
  writeSqueezeOutcome(options, world, run, folder);
  deliverSession(options, folder);
  return {folder, run.quit};
}

void addSqueeze(CLI::App& program) {
  const auto options = std::make_shared<SessionOptions>();
  options->command = "squeeze";
  CLI::App* command = program.add_subcommand(
      "squeeze",
      "A training session: which of two things in the hand is harder, which is heavier?");
  command->footer(kSqueezeExamples);
  command->add_option("--task", options->task, "Task file (default: the shipped one)")
      ->type_name("FILE");
  addRunArguments(*command, *options);
  command->callback([options] { runSqueezeCommand(*options); });
}

}  // namespace palpa::cli
