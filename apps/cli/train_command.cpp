#include <memory>

#include "anatomy/geometry/error.h"
#include "apps/cli/commands.h"
#include "apps/cli/session_arguments.h"
#include "apps/cli/session_commands.h"
#include "apps/station/json_file.h"

namespace palpa::cli {
namespace {

/// An option that means nothing here is a misunderstanding, not a wish.
void refuseNeedleOptions(const CLI::App& given, const std::string& engine) {
  CLI::App known;
  SessionOptions unused;
  addRunArguments(known, unused);
  if (engine == "palpation") addAugmentArgument(known, unused);
  for (const CLI::Option* option : given.get_options()) {
    const std::string name = option->get_name();
    if (option->count() > 0 && name != "--task" && !known.get_option_no_throw(name))
      throw UsageError("has no meaning for this task", name,
                       "Leave it out; palpa " + engine + " --help lists what there is");
  }
}

}  // namespace

SessionLeft runSessionCommand(const std::string& engine, SessionOptions options) {
  if (engine == "palpation") return runPalpationCommand(std::move(options));
  if (engine == "surface") return runSearchCommand(std::move(options));
  if (engine == "squeeze") return runSqueezeCommand(std::move(options));
  return runParacentesisCommand(std::move(options));
}

void addTrain(CLI::App& program) {
  const auto options = std::make_shared<SessionOptions>();
  CLI::App* command = program.add_subcommand("train", "A training session from a task file");
  command->footer(
      "Examples:\n  palpa train --task assets/tasks/paracentesis.json --operator expert --fast\n  "
      "palpa train --task assets/tasks/palpation_prostate.json --operator expert --fast\n  palpa "
      "train --task assets/tasks/bone_pin.json --augment on --operator expert --fast");
  command->add_option("--task", options->task, "Task file")->required()->type_name("FILE");
  addSessionArguments(*command, *options);
  command->callback([options, command] {
    options->command = "train";
    const std::string engine = station::JsonFile(options->task).text("engine");
    if (engine == "palpation" || engine == "squeeze" || engine == "surface")
      refuseNeedleOptions(*command, engine == "surface" ? "search" : engine);
    runSessionCommand(engine, *options);
  });
}

}  // namespace palpa::cli
