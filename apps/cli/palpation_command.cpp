#include <map>
#include <memory>

#include "anatomy/geometry/error.h"
#include "apps/cli/commands.h"
#include "apps/cli/output_folder.h"
#include "apps/cli/palpation_session.h"
#include "apps/cli/session_arguments.h"
#include "apps/cli/session_commands.h"
#include "apps/cli/session_records.h"
#include "apps/station/assets.h"

namespace palpa::cli {
namespace {

constexpr const char* kPalpationExamples = R"(Examples:
  palpa palpation --operator expert --fast --out A
      a simulated examiner searches silicone for lumps that are not there; open A/report.html
  palpa palpation --preset abdomen --operator expert --fast
      the liver's edge is felt in every case, and is no lump
  palpa palpation --preset prostate --operator novice --trials 8 --fast
      a smaller phantom, eight cases: so many it takes to pass or fail
  palpa palpation --station my_station.json --guidance on --trials 16
      you, on a station with a haptic device and a force sensor; help that fades, every other case without
  palpa palpation
      you, with a display and a mouse, on the virtual bench: nothing is felt, but what a sensor feels is drawn; not scored
Button 1 of the device: here is a lump. With a mouse: move it over the phantom, hold the left button to press, M: here is a lump. Then grade it: 1 soft, 2 hard, 3 fixed, 4 mobile, 5-8: 10, 15, 20,
25 mm. Keys: Enter start or go on, D done, P pause, A abort, F1-F4 void, space EMERGENCY STOP, R re-arm, Escape leave.)";

const std::map<std::string, std::string> kPresets{{"abdomen", "tasks/palpation_abdomen.json"},
                                                  {"breast", "tasks/palpation_breast.json"},
                                                  {"prostate", "tasks/palpation_prostate.json"}};

}  // namespace

SessionLeft runPalpationCommand(SessionOptions options) {
  settle(options);
  if (options.headset)
    throw UsageError("does not show palpation yet", "--display openxr",
                     "Choose window or offscreen");
  const PalpationWorld world(options);
  settleOperator(options, world.station);
  checkTrainee(options);
  const std::filesystem::path folder = makeOutputFolder(options.out, options.command);
  const PalpationRun run = runPalpation(options, world, folder);
  writePalpationOutcome(options, world, run, folder);
  deliverSession(options, folder);
  return {folder, run.quit};
}

void addPalpation(CLI::App& program) {
  const auto options = std::make_shared<SessionOptions>();
  options->command = "palpation";
  CLI::App* command =
      program.add_subcommand("palpation", "A training session: search soft tissue for lumps");
  command->footer(kPalpationExamples);
  const auto preset = std::make_shared<std::string>("breast");
  command
      ->add_option("--preset", *preset, "Phantom and cases: breast (default), abdomen or prostate")
      ->check(CLI::IsMember(kPresets))
      ->type_name("abdomen|breast|prostate");
  command->add_option("--task", options->task, "Task file, in place of a preset")
      ->type_name("FILE");
  const auto on_off = [command](const char* name, bool& value, const char* help) {
    command
        ->add_option_function<std::string>(
            name, [&value](const std::string& text) { value = text == "on"; }, help)
        ->check(CLI::IsMember({"on", "off"}))
        ->type_name("on|off");
  };
  on_off("--guidance", options->guidance,
         "A ring and the map of what was felt, in every other case, fading (default off)");
  on_off("--see-through", options->see_through,
         "Show the lumps (default off); such trials are not scored");
  addAugmentArgument(*command, *options);
  addRunArguments(*command, *options);
  command->callback([options, preset] {
    if (options->task.empty()) options->task = station::assetFile(kPresets.at(*preset)).string();
    runPalpationCommand(*options);
  });
}

}  // namespace palpa::cli
