#include <map>
#include <memory>

#include "anatomy/base/error.h"
#include "anatomy/base/json_file.h"
#include "apps/cli/arguments.h"
#include "apps/cli/commands.h"
#include "apps/cli/values.h"
#include "apps/session/whole_session.h"
#include "apps/station/assets.h"
#include "apps/training/engine.h"
#include "apps/trial/keys.h"

namespace palpa::cli {

using training::Engine;

namespace {

std::string withKeys(const char* examples, Engine engine) {
  return examples + ("\n" + trial::keysText(engine));
}

}  // namespace

namespace {

constexpr const char* kSessionExamples = R"(Examples:
  palpa subclavian
      a session; with a display you hold the needle (mouse: drag = over the skin, wheel = along the
      needle, arrows = turn, Z/X (left-handed: period/comma) = plunger, T = skin, space = EMERGENCY STOP)
  palpa subclavian --operator expert --seed 1 --fast --out A
      a simulated expert, in virtual time: the same command gives the same numbers
  palpa subclavian --operator novice --force-feedback off --trials 5 --fast
      the same without force feedback, five trials
  palpa subclavian --operator expert --trials 100 --fast --no-views --tracking model
      many trials in little time: the board is tracked without drawing the camera's pictures
  palpa subclavian --camera 'shots/left*.jpg' --intrinsics left.yml --board chessboard:9x6:0.025 --fast
      the patient on your own recorded pictures
  palpa subclavian --sound off
      in silence: no heart, no blood, no alarm is heard; key S does that during a session
  palpa subclavian --igtl 18944
      the same session in 3D Slicer: there, an OpenIGTLink connector, client, localhost, port 18944)";

}  // namespace

void addSubclavian(CLI::App& program) {
  const auto options = std::make_shared<session::SessionOptions>();
  CLI::App* command = program.add_subcommand(
      "subclavian", "A training session: access to the subclavian vein from below the clavicle");
  command->alias(kNameOfBefore);
  command->footer(withKeys(kSessionExamples, Engine::needle));
  addSessionArguments(*command, *options);
  command->callback([options] { session::holdNeedleSession(*options); });
}

namespace {

constexpr const char* kPalpationExamples = R"(Examples:
  palpa palpation --operator expert --fast --out A
      a simulated examiner searches silicone for lumps that are not there; open A/report.html
  palpa palpation --preset abdomen --operator expert --fast
      the liver's edge is felt in every case, and is not a lump
  palpa palpation --preset prostate --operator novice --trials 8 --fast
      a smaller phantom, eight cases: the fewest on which a trainee passes or fails
  palpa palpation --preset neck --operator expert --trials 2 --fast
      a thyroid beside its windpipe, curved as a neck is; so are breast_curved, abdomen_curved,
      prostate_curved and forearm
  palpa palpation --preset taken --operator expert --trials 8 --fast
      a lump that really lies in the silicone: felt in half of the cases, taken away in the others; what of that is passive is printed first
  palpa palpation --tools 2 --operator expert --fast
      two fingers side by side, each on a device of its own; what is found is rolled between them
  palpa palpation --tools 2 --second finger --operator expert --fast
      the second is a finger of the other hand, tracked, without a force sensor: its force is estimated
  palpa palpation --surface rubber --operator expert --fast
      the same lumps in another of the four surfaces that can lie on the virtual bench
  palpa calibrate object --mockup ribs --out ribs
  palpa palpation --surface ribs --map ribs/object.json --operator expert --fast
      on a block with two ribs below, learnt by touch before: the map is drawn on it, and what is
      rendered follows it
  palpa palpation --station my_station.json --guidance on --trials 16
      you, on a station with a haptic device and a force sensor; help that fades; every other case is without it
  palpa palpation
      you, with a display and a mouse, on the virtual bench: nothing is felt, but what a sensor feels is drawn; not scored
Button 1 of the device: here is a lump. With a mouse: move it over the phantom, hold the left button to press, M: here is a lump. Then say how hard, how mobile and how large it is.)";

const std::map<std::string, std::string> kPresets{
    {"abdomen", "tasks/palpation_abdomen.json"},
    {"abdomen_curved", "tasks/palpation_abdomen_curved.json"},
    {"breast", "tasks/palpation_breast.json"},
    {"breast_curved", "tasks/palpation_breast_curved.json"},
    {"forearm", "tasks/palpation_forearm.json"},
    {"neck", "tasks/palpation_neck.json"},
    {"prostate", "tasks/palpation_prostate.json"},
    {"prostate_curved", "tasks/palpation_prostate_curved.json"},
    {"taken", "tasks/palpation_taken.json"}};

}  // namespace

void addPalpation(CLI::App& program) {
  const auto options = std::make_shared<session::SessionOptions>();
  options->command = "palpation";
  CLI::App* command =
      program.add_subcommand("palpation", "A training session: search soft tissue for lumps");
  command->footer(withKeys(kPalpationExamples, Engine::palpation));
  const auto preset = std::make_shared<std::string>("breast");
  command
      ->add_option(
          "--preset", *preset,
          "Phantom and cases: breast (default), abdomen, prostate, with flat tops; breast_curved, "
          "abdomen_curved, prostate_curved, neck, forearm: shaped as they are; taken: a real lump "
          "that is felt or taken away")
      ->check(oneOf(keysOf(kPresets)))
      ->type_name("NAME");
  command->add_option("--task", options->task, "Task file, in place of a preset")
      ->type_name("FILE")
      ->check(somethingThere("tasks"));
  const auto on_off = [command](const char* name, bool& value, const char* help) {
    command
        ->add_option_function<std::string>(
            name, [&value](const std::string& text) { value = text == "on"; }, help)
        ->check(oneOf({"on", "off"}))
        ->type_name("on|off");
  };
  on_off("--guidance", options->guidance,
         "A ring and the map of what was felt, in every other case, fading (default off)");
  on_off("--see-through", options->see_through,
         "Show the lumps (default off); such trials are not scored");
  addFingerArguments(*command, *options);
  addObjectArguments(*command, *options);
  on_off(
      "--show-map", options->show_map,
      "Draw the map's stiffness on what is felt (default on; not with --guidance on, which draws "
      "its own)");
  addAugmentArgument(*command, *options);
  addRunArguments(*command, *options);
  command->callback([options, preset] {
    if (options->task.empty()) options->task = station::assetFile(kPresets.at(*preset)).string();
    session::holdPalpation(*options);
  });
}

namespace {

constexpr const char* kSqueezeExamples = R"(Examples:
  palpa squeeze --operator expert --fast --trials 16 --out A
      a simulated person compares two things in the hand, one after the other; open A/report.html
  palpa squeeze --operator novice --fast --trials 16 --force-feedback off
      the same without force feedback: both feel alike, and the answers are guesses
So far two devices can only be simulated: a person cannot take part yet.)";

}  // namespace

void addSqueeze(CLI::App& program) {
  const auto options = std::make_shared<session::SessionOptions>();
  options->command = "squeeze";
  CLI::App* command = program.add_subcommand(
      "squeeze",
      "A training session: which of two things in the hand is harder, which is heavier?");
  command->footer(withKeys(kSqueezeExamples, Engine::squeeze));
  command->add_option("--task", options->task, "Task file (default: the shipped one)")
      ->type_name("FILE")
      ->check(somethingThere("tasks"));
  addRunArguments(*command, *options);
  command->callback([options] { session::holdSqueeze(*options); });
}

namespace {

void addSortArgument(CLI::App& command, session::SessionOptions& options) {
  command.add_flag("--sort", options.sort,
                   "Friction: put several surfaces in order, in place of comparing two");
}

constexpr const char* kFrictionExamples = R"(Examples:
  palpa friction --operator expert --fast --trials 16 --out A
      a simulated person strokes over two surfaces, one after the other: which is rougher? Open A/report.html
  palpa friction --surface leather --operator expert --fast --trials 16
      on another of the four surfaces that can lie on the virtual bench
  palpa friction --sort --operator expert --fast --trials 4 --out B
      four surfaces, put in order from the smoothest to the roughest
  palpa friction --operator novice --fast --trials 16 --force-feedback off
      the same without force feedback: all are the same silicone, and the answers are guesses
  palpa friction --station my_station.json --trials 16
      you, on a station with a haptic device and a force sensor
Stroke over the silicone; lift; D: the next surface lies there, in a circle and as often as you like. Then say which is rougher: 1 or 2. With --sort: their numbers from the smoothest to the roughest.)";

}  // namespace

void addFriction(CLI::App& program) {
  const auto options = std::make_shared<session::SessionOptions>();
  options->command = "friction";
  CLI::App* command = program.add_subcommand(
      "friction",
      "A training session: which of two surfaces is rougher? Or several in their order");
  command->footer(withKeys(kFrictionExamples, Engine::friction));
  command->add_option("--task", options->task, "Task file (default: the shipped one)")
      ->type_name("FILE")
      ->check(somethingThere("tasks"));
  addSortArgument(*command, *options);
  addObjectArguments(*command, *options);
  addRunArguments(*command, *options);
  command->callback([options] { session::holdFriction(*options); });
}

namespace {

constexpr const char* kPulseExamples = R"(Examples:
  palpa pulse --operator expert --fast --trials 6 --out A
      a simulated examiner finds pulses on silicone, counts them for 30 seconds and names their rhythm; open A/report.html
  palpa pulse --operator novice --fast --trials 6
      one who presses too hard and feels less
  palpa pulse --operator expert --fast --force-feedback off
      the same without force feedback: nothing beats, and what is said is a guess
  palpa pulse --station my_station.json --trials 6
      you, on a station with a haptic device and a force sensor
Press lightly across the artery's usual line, from the middle outward; hold still on the pulse and press the device's button: that marks it, the last mark counts. D: the count begins, and ends by itself after 30 seconds. Type the number of beats, then D. Then the rhythm: 1 regular, 2 regular with premature beats, 3 irregular.)";

}  // namespace

void addPulse(CLI::App& program) {
  const auto options = std::make_shared<session::SessionOptions>();
  options->command = "pulse";
  CLI::App* command = program.add_subcommand(
      "pulse", "A training session: find a pulse by feel, count it, name its rhythm");
  command->footer(withKeys(kPulseExamples, Engine::pulse));
  command->add_option("--task", options->task, "Task file (default: the shipped one)")
      ->type_name("FILE")
      ->check(somethingThere("tasks"));
  addObjectArguments(*command, *options);
  addRunArguments(*command, *options);
  command->callback([options] { session::holdPulse(*options); });
}

namespace {

constexpr const char* kSearchExamples = R"(Examples:
  palpa search --operator expert --mode all --trials 8 --fast --out A
      a simulated person searches the same floors with full stiffness, with a fifth of it, and with that augmented; open A/report.html
  palpa search --operator novice --mode augmented --trials 20 --fast
      one mode only
  palpa search --operator expert --mode augmented --blocks --fast
      the task's blocks: baseline, training in this mode, evaluation
  palpa search --station my_station.json --mode real --trials 20
      you, on a station with a haptic device and a "floor"
Three things lie hidden on a floor; one is rougher than the others. Find it, and stay in its middle.)";

}  // namespace

void addSearch(CLI::App& program) {
  const auto options = std::make_shared<session::SessionOptions>();
  options->command = "search";
  CLI::App* command = program.add_subcommand(
      "search", "A training session: find the rough one of three hidden things by touch");
  command->footer(withKeys(kSearchExamples, Engine::search));
  command->add_option("--task", options->task, "Task file (default: the shipped one)")
      ->type_name("FILE")
      ->check(somethingThere("tasks"));
  command
      ->add_option(
          "--mode", options->mode,
          "How the floor is rendered: as stiff as the device can render (real, the default), a "
          "fifth of that (degraded), that with cues added (augmented), or each episode in all "
          "three")
      ->check(oneOf({"real", "degraded", "augmented", "all"}))
      ->type_name("all|augmented|degraded|real");
  command->add_flag("--blocks", options->blocks,
                    "The task's blocks in place of --trials; training in the chosen mode");
  addRunArguments(*command, *options);
  command->callback([options] { session::holdSearch(*options); });
}

namespace {

/// What a session of this kind takes.
void addArgumentsOf(Engine engine, CLI::App& command, session::SessionOptions& options) {
  if (engine == Engine::needle) return addSessionArguments(command, options);
  addRunArguments(command, options);
  if (engine == Engine::palpation) {
    addFingerArguments(command, options);
    addAugmentArgument(command, options);
  }
  if (engine == Engine::friction) addSortArgument(command, options);
  if (engine == Engine::palpation || engine == Engine::friction || engine == Engine::pulse)
    addObjectArguments(command, options);
}

/// An option that means nothing here is a misunderstanding, not a wish.
void refuseOthersOptions(const CLI::App& given, Engine engine) {
  CLI::App known;
  session::SessionOptions unused;
  addArgumentsOf(engine, known, unused);
  for (const CLI::Option* option : given.get_options()) {
    const std::string name = option->get_name();
    if (option->count() > 0 && name != "--task" && !known.get_option_no_throw(name))
      throw UsageError(
          "has no meaning for this task", name,
          "Leave it out; palpa " + training::commandOf(engine) + " --help lists what there is");
  }
}

}  // namespace

void addTrain(CLI::App& program) {
  const auto options = std::make_shared<session::SessionOptions>();
  CLI::App* command = program.add_subcommand("train", "A training session from a task file");
  command->footer(
      "Examples:\n  palpa train --task assets/tasks/paracentesis.json --operator expert --fast\n  "
      "palpa train --task assets/tasks/palpation_prostate.json --operator expert --fast\n  palpa "
      "train --task assets/tasks/bone_pin.json --augment on --operator expert --fast\n  palpa "
      "train --task assets/tasks/palpation_breast.json --tools 2 --operator expert --fast");
  command->add_option("--task", options->task, "Task file")
      ->required()
      ->type_name("FILE")
      ->check(somethingThere("tasks"));
  addSessionArguments(*command, *options);
  addFingerArguments(*command, *options);
  addObjectArguments(*command, *options);
  addSortArgument(*command, *options);
  command->callback([options, command] {
    options->command = "train";
    const Engine engine = training::engineIn(JsonFile(options->task));
    refuseOthersOptions(*command, engine);
    session::holdSession(engine, *options);
  });
}

}  // namespace palpa::cli
