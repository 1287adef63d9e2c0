#include <memory>

#include "apps/cli/commands.h"
#include "apps/cli/demonstration.h"
#include "apps/cli/needle_session.h"
#include "apps/cli/output_folder.h"
#include "apps/cli/session_arguments.h"
#include "apps/cli/session_commands.h"
#include "apps/cli/session_outcome.h"
#include "apps/cli/session_records.h"

namespace palpa::cli {
namespace {

constexpr const char* kSessionExamples = R"(Examples:
  palpa paracentesis
      a session; with a display you hold the needle (mouse: drag = over the skin, wheel = along the
      needle, arrows = turn, Z/X (left-handed: period/comma) = plunger, T = skin, space = EMERGENCY STOP)
  palpa paracentesis --operator expert --seed 1 --fast --out A
      a simulated expert, in virtual time: the same command gives the same numbers
  palpa paracentesis --operator novice --force-feedback off --trials 5 --fast
      the same without force feedback, five trials
  palpa paracentesis --camera 'shots/left*.jpg' --intrinsics left.yml --board chessboard:9x6:0.025 --fast
      the patient on your own recorded pictures
  palpa paracentesis --igtl 18944
      the same session in 3D Slicer: there, an OpenIGTLink connector, client, localhost, port 18944
Keys in a session: Enter start or go on, P pause, A abort, F1-F4 void (interrupted, technical fault,
trainee stopped, other), space emergency stop, R re-arm, Escape leave.)";

}  // namespace

SessionLeft runParacentesisCommand(SessionOptions options) {
  settle(options);
  NeedleWorld world(options);
  settleOperator(options, world.station);
  checkTrainee(options);
  const std::filesystem::path folder = makeOutputFolder(options.out, options.command);
  if (options.who == OperatorKind::person && options.demonstration)
    showDemonstration(options, world, folder);
  const SessionResult result = runNeedleSession(options, world, folder);
  writeOutcome(options, world, result, folder);
  deliverSession(options, folder);
  return {folder, result.quit};
}

void addParacentesis(CLI::App& program) {
  const auto options = std::make_shared<SessionOptions>();
  CLI::App* command = program.add_subcommand(
      "paracentesis", "A training session: paracentesis of the subclavian vein");
  command->footer(kSessionExamples);
  addSessionArguments(*command, *options);
  command->callback([options] { runParacentesisCommand(*options); });
}

}  // namespace palpa::cli
