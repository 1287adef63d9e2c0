#include "apps/cli/arguments.h"

#include <cstdio>
#include <map>

#include "anatomy/base/error.h"
#include "apps/cli/values.h"
#include "apps/presentation/presentation.h"
#include "apps/record/store/record_store.h"
#include "apps/station/assets.h"

namespace palpa::cli {
namespace {

const std::map<std::string, session::OperatorKind> kOperators{
    {"auto", session::OperatorKind::automatic},
    {"person", session::OperatorKind::person},
    {"expert", session::OperatorKind::expert},
    {"novice", session::OperatorKind::novice}};
const std::map<std::string, scene::Display> kDisplays{{"auto", scene::Display::automatic},
                                                      {"window", scene::Display::window},
                                                      {"offscreen", scene::Display::offscreen}};
constexpr const char* kHeadset = "openxr";
constexpr const char* kWholeMonitor = "full";
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
const std::map<std::string, session::Tracking> kTrackings{{"images", session::Tracking::images},
                                                          {"model", session::Tracking::model}};
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
      ->check(oneOf(keysOf(choices)))
      ->type_name(names);
}

/// A name, or a file as in assets/operators.
void addOperator(CLI::App& command, session::SessionOptions& o) {
  command
      .add_option_function<std::string>(
          "--operator",
          [&o](const std::string& text) {
            const auto named = kOperators.find(text);
            o.who = named == kOperators.end() ? session::OperatorKind::custom : named->second;
            o.operator_file = named == kOperators.end() ? text : "";
          },
          "Who performs: you, a simulated expert or novice, or a simulated operator of your own: "
          "a file like those in assets/operators")
      ->check(oneOfOrFile(keysOf(kOperators)))
      ->type_name("auto|expert|novice|person|FILE");
}

void addRecordedPictures(CLI::App& command, session::SessionOptions& o) {
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

}  // namespace

void addWindowArguments(CLI::App& command, scene::WindowPlace& place) {
  command
      .add_option_function<std::string>(
          "--window",
          [&place](const std::string& text) {
            place.full_screen = text == kWholeMonitor;
            if (!place.full_screen) std::sscanf(text.c_str(), "%dx%d", &place.width, &place.height);
          },
          "How large the window is (default: as it was last); full: all of the monitor, as F11 "
          "makes it and takes it back")
      ->check(writtenAs("full|[1-9][0-9]{2,4}x[1-9][0-9]{2,4}", "full or a size such as 1600x900"))
      ->type_name("SIZE|full");
  command
      .add_option("--monitor", place.monitor,
                  "Where the window is, by the monitor's number from the left, or its name "
                  "(default: where it was last); palpa doctor lists them")
      ->check(writtenAs("[^-].*", "a monitor's number or name"))
      ->type_name("NUMBER|NAME");
}

void addGpuArgument(CLI::App& command) {
  command
      .add_option_function<std::string>(
          "--gpu", [](const std::string& text) { scene::drawBy(text); },
          "By what pictures are drawn without a window: auto (the default), none (the processor) "
          "or a graphics card's number; palpa doctor lists them")
      ->check(writtenAs("auto|none|[1-9][0-9]?", "auto, none or a card's number"))
      ->type_name("auto|none|NUMBER");
}

void addPlaceArguments(CLI::App& command, session::SessionOptions& o) {
  command.add_option("--station", o.station, "Station file; default: the virtual bench")
      ->type_name("FILE")
      ->check(somethingThere("stations"));
  addOperator(command, o);
  command.add_flag("--fast", o.fast, "Virtual time: as fast as the computer can; repeats exactly");
  command.add_flag("--record-video", o.record_video,
                   "Keep the camera's pictures and their poses: camera.mjpeg and a table");
  command
      .add_option("--film-room", o.film_room,
                  "Film the room with this camera (/dev/video2; or a film, to try it) for the "
                  "debrief: room.mjpeg; needs --film-agreed")
      ->type_name("CAMERA");
  command.add_flag("--film-agreed", o.film_agreed,
                   "Who trains was asked and has agreed to be filmed in this session");
  command.add_flag("--no-views", o.no_views, "Render nothing; changes no score");
  choice(command, "--tracking", o.tracking, kTrackings,
         "The virtual bench's board is tracked in its camera's pictures (images, the default), or "
         "by a model of the errors that they cause, which is faster (model; with --fast "
         "--no-views)");
  choice(command, "--force-colours", o.force_colours, kForceColours,
         "Colours of the force arrows: grays (paper, the default), or ones that colour-blind "
         "people can tell apart (safe)");
  choice(command, "--stereo", o.stereo, kStereos,
         "For two eyes (default none); side-by-side, top-bottom: for 3D screens that halve the "
         "whole picture; anaglyph: for red and cyan glasses");
  choice(command, "--inset", o.inset, kInsets,
         "A small picture in the corner (default none); camera: what the camera sees, without the "
         "overlay");
  command
      .add_option_function<std::string>(
          "--display",
          [&o](const std::string& text) {
            o.headset = text == kHeadset,
            o.display = o.headset ? scene::Display::automatic : kDisplays.at(text);
          },
          "Where to show it; openxr: on a headset, and on the desktop beside it")
      ->check(oneOf({"auto", "window", "offscreen", kHeadset}))
      ->type_name("auto|offscreen|openxr|window");
  choice(command, "--sound", o.sound, kOnOff,
         "Blood in the syringe, alarms and the patient's heart can be heard by whoever sits at the "
         "window or wears the headset (default on)");
  addWindowArguments(command, o.window);
  addGpuArgument(command);
  command.add_flag("--assess", o.assess,
                   "Assessment: every aid is off, as in an examination; a needle trial ends at "
                   "the fourth pass");
  command.add_option("--out", o.out, "Folder for the results (default out/<command>-<time>)")
      ->type_name("DIR");
  command
      .add_option(
          "--bench-seed", o.bench_seed,
          "Seed of the virtual bench's truth: the one it was calibrated with (default: as --seed)")
      ->check(moreThanZero());
  command
      .add_option(
          "--live", o.live,
          "Let a console watch and control the session, through a local socket at this path")
      ->type_name("SOCKET");
  command.add_option("--rate", o.rate_Hz, "Ticks of the haptic loop per second (default 1000)")
      ->check(inRange(1000.0, 4000.0, "a second"));
  command.add_option("--cpu", o.cpu, "Keep the haptic thread on this processor")
      ->check(inRange(0, 1023));
  command.add_flag("--quiet", o.quiet, "No progress on standard error");
}

void addRunArguments(CLI::App& command, session::SessionOptions& o) {
  addPlaceArguments(command, o);
  command.add_option("--seed", o.seed, "Everything random follows from it (default 1)")
      ->check(atLeastZero());
  choice(command, "--force-feedback", o.force_feedback, kOnOff, "Render forces on the device");
  command.add_option("--trials", o.trials, "Number of trials (default 1)")->check(inRange(1, 1000));
  command
      .add_option("--trainee", o.trainee, "Pseudonym of the trainee, never a name (default T000)")
      ->check(record::whyNoPseudonym);
  command
      .add_option(
          "--records", o.records,
          "Add finished trials to these records: a file, or postgresql://user@host/database "
          "(default: $PALPA_RECORDS, else nobody is recorded)")
      ->envname("PALPA_RECORDS")
      ->type_name("FILE|URL");
  CLI::Option* igtl =
      command
          .add_option(
              "--igtl", o.igtl_port,
              "Let 3D Slicer and other programs follow this session live, by OpenIGTLink: where "
              "tool and patient are, forces, events. They connect to this port (usual: 18944)")
          ->check(inRange(1, 65535))
          ->type_name("PORT");
  command
      .add_option(
          "--igtl-listen", o.igtl_listen,
          "Who may follow: 127.0.0.1, programs on this computer (default); this computer's own "
          "address, or 0.0.0.0: anyone who can reach it over the network, without password or "
          "encryption")
      ->type_name("ADDRESS")
      ->needs(igtl);
  command
      .add_option_function<std::string>(
          "--presentation",
          [&o](const std::string& text) {
            o.presentation = presentation::presentationNamed(
                text, station::assetFile("presentations"), "", "--presentation");
          },
          "What may be seen: practice, assessed, pilot, substitution, or a file like those in "
          "assets/presentations. Default: practice; without force feedback practice that does not "
          "show the force either; assessed with --assess")
      ->check(oneOfOrFile(shippedNames("presentations")))
      ->type_name("NAME|FILE");
  command.add_flag_callback(
      "--no-navigation", [&o] { o.navigation = false; }, "The view stays fixed");
}

void addAugmentArgument(CLI::App& command, session::SessionOptions& o) {
  choice(command, "--augment", o.augment, kOnOff,
         "Add the task's own cues to the forces, each in its part of the task (default off)");
}

void addFingerArguments(CLI::App& command, session::SessionOptions& options) {
  command
      .add_option("--tools", options.tools,
                  "Fingers that press (default 1); 2: each on a device of its own, side by side")
      ->check(CLI::Range(1, 2))
      ->type_name("1|2");
  command
      .add_option_function<std::string>(
          "--second",
          [&options](const std::string& what) { options.tracked_finger = what == "finger"; },
          "What the second finger is on: a device with a force sensor (default), or nothing: a "
          "bare finger that is tracked, whose force is estimated")
      ->check(oneOf({"device", "finger"}))
      ->type_name("device|finger");
}

void addObjectArguments(CLI::App& command, session::SessionOptions& options) {
  command
      .add_option(
          "--surface", options.surface,
          "What lies on the virtual bench: oiled gel, skin, leather or rubber, or, with its "
          "map, an object that is not the same everywhere")
      ->type_name("NAME");
  command
      .add_option("--map", options.map,
                  "What it is like from place to place: the object.json of palpa calibrate object; "
                  "the laws of what is felt follow it")
      ->type_name("FILE")
      ->check(somethingThere(""));
}

void addSessionArguments(CLI::App& command, session::SessionOptions& o) {
  addRunArguments(command, o);
  addAugmentArgument(command, o);
  command
      .add_option("--patient", o.patient,
                  "Patient file (.glb); default: built from reference figures")
      ->type_name("FILE")
      ->check(somethingThere("patients"));
  command
      .add_option("--patient-seed", o.patient_seed,
                  "Draw another patient; 0: the reference patient")
      ->check(atLeastZero());
  choice(command, "--side", o.side, kSides, "Side that is punctured");
  choice(command, "--handedness", o.left_handed, kHands, "The trainee's hand");
  choice(command, "--operator-knows", o.knows_patient, kKnowledge,
         "Where a simulated operator expects the vein: as in most people (mean, the default), or "
         "as in this patient's images");
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
  command.add_option("--expert-path", o.expert_path, "Expert path; default: the task's")
      ->type_name("FILE")
      ->check(somethingThere("tasks"));
  choice(
      command, "--geometry", o.exact_geometry, kGeometries,
      "What the haptic loop knows of the shape: snapshots at 60 Hz, or the full mesh in every tick "
      "(slow; with --fast)");
  addRecordedPictures(command, o);
}

}  // namespace palpa::cli
