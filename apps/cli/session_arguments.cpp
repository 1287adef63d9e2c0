#include "apps/cli/session_arguments.h"

#include <cstdio>
#include <cstdlib>
#include <map>

#include "anatomy/geometry/error.h"
#include "apps/record/store/record_store.h"

namespace palpa::cli {
namespace {

const std::map<std::string, OperatorKind> kOperators{{"auto", OperatorKind::automatic},
                                                     {"person", OperatorKind::person},
                                                     {"expert", OperatorKind::expert},
                                                     {"novice", OperatorKind::novice}};
const std::map<std::string, scene::Display> kDisplays{{"auto", scene::Display::automatic},
                                                      {"window", scene::Display::window},
                                                      {"offscreen", scene::Display::offscreen}};
constexpr const char* kHeadset = "openxr";
const std::map<std::string, anatomy::Side> kSides{{"right", anatomy::Side::right},
                                                  {"left", anatomy::Side::left}};
const std::map<std::string, scene::ForceColours> kForceColours{
    {"paper", scene::ForceColours::paper}, {"safe", scene::ForceColours::safe}};
const std::map<std::string, scene::Stereo> kStereos{{"none", scene::Stereo::none},
                                                    {"side-by-side", scene::Stereo::side_by_side},
                                                    {"top-bottom", scene::Stereo::top_bottom},
                                                    {"anaglyph", scene::Stereo::anaglyph}};
const std::map<std::string, scene::Inset> kInsets{{"none", scene::Inset::none},
                                                  {"camera", scene::Inset::camera}};
const std::map<std::string, bool> kOnOff{{"on", true}, {"off", false}};
const std::map<std::string, bool> kGeometries{{"local", false}, {"exact", true}};
const std::map<std::string, bool> kKnowledge{{"mean", false}, {"patient", true}};
const std::map<std::string, bool> kHands{{"right", false}, {"left", true}};

template <class T>
CLI::Option* choice(CLI::App& command, const std::string& name, T& value,
                    const std::map<std::string, T>& choices, const std::string& help) {
  std::string names;
  for (const auto& [text, ignored] : choices) names += (names.empty() ? "" : "|") + text;
  return command
      .add_option_function<std::string>(
          name, [&value, &choices](const std::string& text) { value = choices.at(text); }, help)
      ->check(CLI::IsMember(choices))
      ->type_name(names);
}

void addRecordedPictures(CLI::App& command, SessionOptions& o) {
  command
      .add_option("--camera", o.camera,
                  "Recorded pictures or a film instead of the station's camera, e.g. "
                  "'shots/left*.jpg', camera.mjpeg")
      ->type_name("GLOB|FILM");
  command
      .add_option("--intrinsics", o.intrinsics,
                  "Camera calibration of those pictures (OpenCV's YAML or ours)")
      ->type_name("FILE");
  command
      .add_option("--board", o.board,
                  "Board in the pictures: tags:6x4:0.030:0.0075 or chessboard:9x6:0.025 (metres)")
      ->type_name("SPEC");
}

void checkPerson(const SessionOptions& o) {
  if (o.fast)
    throw UsageError("cannot go with --operator person", "--fast", "A person needs real time");
  if (o.no_views || (o.display != scene::Display::window && !o.headset))
    throw UsageError("needs a window", "--operator person",
                     "Set DISPLAY, or choose --operator expert or novice on the virtual bench");
}

/// What was asked for is refused; what is on by default is taken away, with a word.
void settleAssessment(SessionOptions& o) {
  const std::pair<const char*, bool> aids[]{
      {"--guide on", o.guide},
      {"--guidance on", o.guidance},
      {"--see-through on", o.see_through},
      {"--augment on", o.augment},
      {"--skin-deflection on", o.skin_deflection},
      {"--mode augmented", o.mode == "augmented" || o.mode == "all"},
      {"--blocks", o.blocks}};
  for (const auto& [option, given] : aids)
    if (given)
      throw UsageError("is an aid or practice, and in an assessment every aid is off",
                       std::string(option) + " with --assess", "Leave one of them out");
  o.role = "assessed";
  o.navigation = o.demonstration = false;
  if (!o.quiet)
    std::puts(
        "Assessment: every aid is off: the view stays fixed, the screen tells neither tissue nor "
        "force, no demonstration");
}

}  // namespace

void addPlaceArguments(CLI::App& command, SessionOptions& o) {
  command.add_option("--station", o.station, "Station file; default: the virtual bench")
      ->type_name("FILE");
  choice(command, "--operator", o.who, kOperators,
         "Who performs: you, or a simulated expert or novice");
  command.add_flag("--fast", o.fast, "Virtual time: as fast as the computer can, repeats exactly");
  command.add_flag("--record-video", o.record_video,
                   "Keep the camera's pictures beside their poses: camera.mjpeg and a table");
  command.add_flag("--no-views", o.no_views, "Render nothing; changes no score");
  choice(
      command, "--force-colours", o.force_colours, kForceColours,
      "Of the force arrows: grays (paper, the default), or told apart by colour-blind eyes (safe)");
  choice(command, "--stereo", o.stereo, kStereos,
         "The large view for two eyes (default none); anaglyph: for red and cyan glasses");
  choice(command, "--inset", o.inset, kInsets,
         "A small picture in the corner (default none); camera: what it sees, without the overlay");
  command
      .add_option_function<std::string>(
          "--display",
          [&o](const std::string& text) {
            o.headset = text == kHeadset,
            o.display = o.headset ? scene::Display::automatic : kDisplays.at(text);
          },
          "Where to show it; openxr: on a headset, and on the desktop beside it")
      ->check(CLI::IsMember({"auto", "window", "offscreen", kHeadset}))
      ->type_name("auto|offscreen|openxr|window");
  command.add_flag("--assess", o.assess,
                   "Assessment: every aid is off, as for an examination; a needle's trial ends at "
                   "the fourth pass");
  command.add_option("--out", o.out, "Folder for the results (default out/<command>-<time>)")
      ->type_name("DIR");
  command
      .add_option(
          "--bench-seed", o.bench_seed,
          "Of the virtual bench's truth: that with which it was calibrated (default: as --seed)")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--live", o.live,
                  "Let a console look on and steer, through a local socket at this path")
      ->type_name("SOCKET");
  command.add_option("--rate", o.rate_Hz, "Ticks of the haptic loop a second (default 1000)")
      ->check(CLI::Range(1000.0, 4000.0));
  command.add_option("--cpu", o.cpu, "Keep the haptic thread on this processor")
      ->check(CLI::Range(0, 1023));
  command.add_flag("--quiet", o.quiet, "No progress on standard error");
}

void addRunArguments(CLI::App& command, SessionOptions& o) {
  addPlaceArguments(command, o);
  command.add_option("--seed", o.seed, "Everything random follows from it (default 1)")
      ->check(CLI::NonNegativeNumber);
  choice(command, "--force-feedback", o.force_feedback, kOnOff, "Render forces on the device");
  command.add_option("--trials", o.trials, "Number of trials (default 1)")
      ->check(CLI::Range(1, 1000));
  command
      .add_option("--trainee", o.trainee, "Pseudonym of the trainee, never a name (default T000)")
      ->check(record::whyNoPseudonym);
  command
      .add_option(
          "--records", o.records,
          "Bring finished trials into these records: a file, or postgresql://user@host/database "
          "(default: $PALPA_RECORDS, else nobody is recorded)")
      ->envname("PALPA_RECORDS")
      ->type_name("FILE|URL");
  CLI::Option* igtl =
      command
          .add_option(
              "--igtl", o.igtl_port,
              "Let 3D Slicer and other programs follow this session live, by OpenIGTLink: where "
              "tool and patient are, forces, events. They connect to this port (usual: 18944)")
          ->check(CLI::Range(1, 65535))
          ->type_name("PORT");
  command
      .add_option(
          "--igtl-listen", o.igtl_listen,
          "Who may follow: 127.0.0.1, programs on this computer (default); this computer's own "
          "address, or 0.0.0.0: whoever reaches it by network, without password or encryption")
      ->type_name("ADDRESS")
      ->needs(igtl);
  command.add_flag_callback(
      "--no-navigation", [&o] { o.navigation = false; }, "The view stays fixed");
}

void addAugmentArgument(CLI::App& command, SessionOptions& o) {
  choice(command, "--augment", o.augment, kOnOff,
         "Add the task's own cues to the forces, each in its part of the task (default off)");
}

void addSessionArguments(CLI::App& command, SessionOptions& o) {
  addRunArguments(command, o);
  addAugmentArgument(command, o);
  command
      .add_option("--patient", o.patient,
                  "Patient file (.glb); default: built from reference figures")
      ->type_name("FILE");
  command
      .add_option("--patient-seed", o.patient_seed,
                  "Draw another patient; 0: the reference patient")
      ->check(CLI::NonNegativeNumber);
  choice(command, "--side", o.side, kSides, "Side that is punctured");
  choice(command, "--handedness", o.left_handed, kHands, "The trainee's hand");
  choice(command, "--operator-knows", o.knows_patient, kKnowledge,
         "Where a simulated one expects the vein: as in most people (mean, the default), or as in "
         "this patient's images");
  choice(
      command, "--skin-deflection", o.skin_deflection, kOnOff,
      "Show the skin giving way under the needle (default off: seeing must not replace feeling)");
  choice(command, "--guide", o.guide, kOnOff,
         "Show a line from the entry point to the vein (default off); such trials are not scored");
  command.add_flag_callback(
      "--no-demonstration", [&o] { o.demonstration = false; },
      "A person starts without an expert's demonstration");
  command.add_flag_callback(
      "--no-familiarisation", [&o] { o.familiarisation = false; },
      "A person starts without a first unscored trial");
  command.add_option("--expert-path", o.expert_path, "Optimal path; default: the task's")
      ->type_name("FILE");
  choice(command, "--geometry", o.exact_geometry, kGeometries,
         "What the tick knows of the shape: snapshots at 60 Hz, or the full mesh in every tick "
         "(slow; with --fast)");
  addRecordedPictures(command, o);
}

void settleOperator(SessionOptions& o, const station::Station& station) {
  const station::DeviceDriver driver = station.device.driver;
  const std::string where = station.file.name() + ", device/driver";
  if (driver == station::DeviceDriver::replay) {
    if (o.who != OperatorKind::automatic)
      throw UsageError("is \"replay\": the recorded hand performs", where, "Leave out --operator");
    o.who = OperatorKind::recorded;
    return;
  }
  if (driver != station::DeviceDriver::bench && isSimulated(o.who))
    throw UsageError("is a real device, which a simulated operator cannot hold", where,
                     "Leave out --operator, or use the virtual bench");
  if (o.who == OperatorKind::automatic) {
    const bool person =
        driver != station::DeviceDriver::bench || o.display == scene::Display::window || o.headset;
    o.who = person ? OperatorKind::person : OperatorKind::expert;
  }
  if (o.knows_patient && !isSimulated(o.who))
    throw UsageError("is for a simulated operator", "--operator-knows",
                     "Add --operator expert or novice, or leave it out");
  if (o.who == OperatorKind::person) checkPerson(o);
  if (o.display != scene::Display::window) o.demonstration = false;  // it is shown in a window
}

void settle(SessionOptions& o) {
  if (o.display == scene::Display::automatic)
    o.display = std::getenv("DISPLAY") && !o.fast && !o.no_views ? scene::Display::window
                                                                 : scene::Display::offscreen;
  if (o.who == OperatorKind::person) checkPerson(o);
  if (o.headset && (o.fast || o.no_views))
    throw UsageError("cannot go with --display openxr", o.fast ? "--fast" : "--no-views",
                     "Leave one of them out: a headset shows what is now");
  if (o.inset != scene::Inset::none &&
      (o.stereo == scene::Stereo::side_by_side || o.stereo == scene::Stereo::top_bottom))
    throw UsageError("would be seen by one eye only", "--inset with --stereo",
                     "Leave one of them out");
  if (o.assess) settleAssessment(o);
  if (o.exact_geometry && !o.fast)
    throw UsageError("needs virtual time", "--geometry exact",
                     "Add --fast: the full mesh takes longer than a tick");
  if (o.display == scene::Display::window && o.fast)
    throw UsageError("cannot go with --display window", "--fast", "Leave one of them out");
  if (!o.camera.empty() && (o.intrinsics.empty() || o.board.empty()))
    throw UsageError("needs --intrinsics and --board", "--camera",
                     "Say which camera took the pictures and which board they show");
  if (o.camera.empty() && (!o.intrinsics.empty() || !o.board.empty()))
    throw UsageError("go with --camera only", "--intrinsics, --board",
                     "The station's camera has its own");
}

}  // namespace palpa::cli
