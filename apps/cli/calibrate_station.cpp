#include <cstdio>
#include <memory>

#include "anatomy/base/error.h"
#include "anatomy/base/sha256.h"
#include "anatomy/base/whole_file.h"
#include "apps/bench/setup_accuracy.h"
#include "apps/calibrate/page.h"
#include "apps/calibrate/rig_adapters.h"
#include "apps/calibrate/sequence.h"
#include "apps/calibrate/watched_picture.h"
#include "apps/cli/calibrate_samples.h"
#include "apps/cli/commands.h"
#include "apps/cli/values.h"
#include "apps/os/file_access.h"
#include "apps/runtime/clock.h"
#include "apps/session/output_folder.h"
#include "apps/station/assets.h"
#include "ar/cameras/recorded_pictures.h"

namespace palpa::cli {
namespace {

using namespace calibrate;
using station::CalibrationKind;

/// On a terminal a line that renews itself, otherwise a line at the beginning and one at the end;
/// each step's where somebody looks on.
class TerminalGuide final : public Guide {
 public:
  TerminalGuide(bool quiet, bool person, WatchedPicture* watched)
      : quiet_(quiet), person_(person), watched_(watched), terminal_(os::errorsGoToTerminal()) {}
  ~TerminalGuide() override {
    if (open_) std::fputs("\n", stderr);
  }
  void ask(const std::string& words) override {
    if (person_) std::fprintf(stderr, "%s\n", words.c_str());
  }
  void progress(const std::string& what, int done, int of, const std::string& live) override {
    if (quiet_) return;
    const bool last = done >= of;
    if (terminal_) {
      std::fprintf(stderr, "\r\033[K%s: %d of %d  %s%s", what.c_str(), done, of, live.c_str(),
                   last ? "\n" : "");
      open_ = !last;
    } else if (last || done == 1 || watched_) {
      std::fprintf(stderr, "%s: %d of %d  %s\n", what.c_str(), done, of, live.c_str());
    }
  }
  void covered(const std::vector<ar::BoardPoint>& points,
               const calibration::CoverageMap& coverage) override {
    if (watched_) watched_->covered(points, coverage);
  }

 private:
  bool quiet_, person_;
  WatchedPicture* watched_;
  bool terminal_, open_ = false;
};

station::Station stationOf(const CalibrateOptions& o) {
  const bool of_sample = o.kind == CalibrationKind::material ||
                         o.kind == CalibrationKind::friction ||
                         o.kind == CalibrationKind::inclusion ||
                         o.kind == CalibrationKind::object || o.kind == CalibrationKind::texture;
  return station::readStation(o.station.empty()
                                  ? station::assetFile(of_sample ? "stations/palpation_bench.json"
                                                                 : "stations/virtual_bench.json")
                                  : std::filesystem::path(o.station));
}

Origin originOf(const CalibrateOptions& o, const station::Station& station) {
  Origin origin;
  origin.station = station.id;
  origin.command =
      "palpa calibrate " + o.name() + (o.recorded() ? "" : " --seed " + std::to_string(o.seed));
  origin.source = o.recorded() ? "recorded files" : "virtual bench, seed " + std::to_string(o.seed);
  origin.simulated = !o.recorded();
  origin.date = runtime::utcNow();
  std::vector<std::filesystem::path> files = o.tables();
  if (!o.images.empty()) files = ar::ImageSequence(o.images, 1).files();
  for (const std::filesystem::path& file : files)
    origin.files.push_back({file.filename().string(), sha256OfFile(file)});
  return origin;
}

/// What was found, on standard output and as a page.
void leave(const CalibrateOptions& o, const station::Station& station, const SetupResult& setup,
           std::vector<std::string> remarks, const std::string& accuracy) {
  session::OutputFolder output(o.out, "calibrate-" + o.name());
  const std::filesystem::path& folder = output.path();
  writeCalibrations(station, setup.calibrations, folder);
  PageHead head{station.title, setup.results.front().file.date,
                setup.results.front().file.simulated, setup.seconds, std::move(remarks)};
  writePage(head, setup.results, folder / "calibration.html");
  if (!accuracy.empty()) writeWhole(folder / "accuracy.json", accuracy + "\n");
  output.keep();
  std::string failed;
  for (const Result& r : setup.results) {
    std::printf("%s%s: %s\n", r.title.c_str(), r.file.simulated ? " (simulated)" : "",
                r.file.verdict.c_str());
    for (const std::string& sentence : r.sentences) std::printf("  %s\n", sentence.c_str());
    if (!r.file.passed()) failed += (failed.empty() ? "" : ", ") + r.title;
  }
  for (const std::string& remark : head.remarks)
    std::printf("Simulated truth: %s\n", remark.c_str());
  std::printf("Written: %s\nUse it: --station %s\n", (folder / "calibration.html").c_str(),
              (folder / "station.json").c_str());
  if (!failed.empty())
    throw Error("did not pass: " + failed, "calibration",
                "Read why in " + (folder / "calibration.html").string() +
                    "; sessions on this station are not scored");
}

void calibrateStation(const CalibrateOptions& o) {
  const station::Station station = stationOf(o);
  const Origin origin = originOf(o, station);
  SetupResult setup;
  if (o.recorded()) {
    setup.results.push_back(fromFiles(o, station, origin));
    setup.calibrations.push_back(asFile(setup.results.back()));
    return leave(o, station, setup, {}, "");
  }
  const bool real_camera = station.camera_setup.driver != station::CameraDriver::bench;
  if (real_camera || station.device.driver != station::DeviceDriver::bench)
    throw Error(std::string("cannot be led through a calibration yet: its ") +
                    (real_camera ? "camera" : "device") +
                    " is real, and the guided calibration knows only simulated ones",
                "station \"" + station.id + "\"", "Record samples, and give them; see --help");
  twin::SetupBench bench(station, o.seed);
  std::optional<WatchedPicture> watched;
  if (!o.watch.empty()) watched.emplace(o.watch);
  TerminalGuide guide(o.quiet, false, watched ? &*watched : nullptr);
  WatchedRig seen(bench, [&](const ar::Frame& frame) {
    if (watched) watched->see(frame);
  });
  CorrectedRig rig(seen);  // by the station's own calibration, where it has one
  if (o.kind && o.kind != CalibrationKind::workspace) rig.correctBy(station.workspace);
  const Scene scene{station, rig, guide};
  if (o.kind) {
    setup.results.push_back(onBench(o, scene, origin));
    restOn(setup.results.back(), station.calibrations);
    setup.calibrations.push_back(asFile(setup.results.back()));
    return leave(o, station, setup, {}, "");
  }
  setup = setUp(scene, origin);
  const bench::SetupAccuracy accuracy = bench::measureAccuracy(
      station, station::withCalibrations(station, setup.calibrations), setup, bench);
  leave(o, station, setup, inWords(accuracy), inJson(accuracy));
}

struct Routine {
  std::optional<CalibrationKind> kind;  ///< none: all
  const char *about, *examples;
};
constexpr Routine kRoutines[] = {
    {CalibrationKind::camera, "The lens: from pictures of a board",
     "Examples:\n  palpa calibrate camera\n      on the virtual bench: a simulated hand holds the "
     "board\n"
     "  palpa calibrate camera --images 'shots/*.png' --board chessboard:9x6:0.025:11 "
     "--all-corners\n"
     "      as other programs do it (corners in squares of 23 px, none left out): to compare with "
     "their figures\n"
     "  palpa calibrate camera --images 'shots/left*.jpg' --board chessboard:9x6:0.025\n      from "
     "your own pictures"},
    {CalibrationKind::tool, "The needle's tip and direction: pivot and spin",
     "Examples:\n  palpa calibrate tool\n  palpa calibrate tool --pivot pivot.csv --spin spin.csv\n"
     "Tables have a header row: x_mm (or x_m), y_, z_, q_w, q_x, q_y, q_z: the end effector in the "
     "device's base."},
    {CalibrationKind::workspace, "The device's systematic position error, from a touched grid",
     "Examples:\n  palpa calibrate workspace --touches grid.csv\nColumns: known_x_mm, ..., "
     "touched_x_mm, ..., end_x_mm, ... (the end effector, where it is known)"},
    {CalibrationKind::registration,
     "Where the device stands: from touched landmarks, from a tag on the tool, or both",
     "Examples:\n  palpa calibrate registration --landmarks touched.csv\n      columns: name, "
     "known_x_mm, ..., touched_x_mm, ..., for (\"check\": not used to fit)\n"
     "  palpa calibrate registration --pairs samples.json\n      a list of [end effector in base, "
     "tag in camera], 4x4, metres; or a table: device_x_m, ..., tag_x_m, ..."},
    {CalibrationKind::latency, "The time between camera and device, from one motion that both saw",
     "Examples:\n  palpa calibrate latency --camera-track camera.csv --device-track "
     "device.csv\nColumns: t_s, x_mm (or x_m), y_, z_"},
    {CalibrationKind::force_sensor, "Bias and tool weight, from readings in different orientations",
     "Examples:\n  palpa calibrate force-sensor --readings readings.csv\nColumns: q_w, ..., "
     "force_x_N, ..., torque_x_Nm, ..."},
    {CalibrationKind::material, "How soft a sample is: from presses",
     "Examples:\n  palpa calibrate material\n      on the virtual palpation bench: a simulated "
     "hand presses the silicone\n  palpa calibrate material --surface rubber\n      another of the "
     "four surfaces that can lie "
     "there: oiled gel, skin, leather, rubber\n  palpa calibrate material --presses presses.csv\n"
     "Columns: t_s; x_mm (or x_m), y_, z_ of the tip's lowest point, z up from the sample's top; "
     "force_x_N, ..."},
    {CalibrationKind::friction, "How a sample's surface rubs: from strokes",
     "Examples:\n  palpa calibrate friction\n  palpa calibrate friction --surface rubber\n  palpa "
     "calibrate friction --strokes "
     "strokes.csv\nColumns as for material"},
    {CalibrationKind::inclusion,
     "What a lump adds to a sample: from presses of one with it and one without",
     "Examples:\n  palpa calibrate inclusion --mockup hard\n"
     "  palpa calibrate inclusion --without plain.csv --strokes strokes.csv --above above.csv "
     "--beside beside.csv --check check.csv --depth-mm 15\n"
     "Columns as for material, and lump_x_mm, ...: how far the lump has moved"},
    {CalibrationKind::object,
     "What a soft thing is like all over: a map of stiffness and friction, from touching it here "
     "and there",
     "Examples:\n  palpa calibrate object --mockup ribs\n      on the virtual palpation bench: a "
     "simulated hand touches a block with two ribs below, where the map knows least\n"
     "  palpa calibrate object --touches touches.csv\n"
     "Columns as for material: touches 3 to 5 mm deep, each pressed, held, slid 10 mm, and lifted"},
    {CalibrationKind::texture,
     "What shakes a tool on a rough surface, over force and speed: from strokes",
     "Examples:\n  palpa calibrate texture --surface ribbed\n      on the virtual bench: a tool is "
     "drawn over a simulated surface\n"
     "  palpa calibrate texture --strokes strokes.csv --check other.csv --mass-g 48 "
     "--forces 0.5,1 --speeds 50,100\n"
     "Columns: t_s, every millisecond; force_N, normal; speed_mm_per_s; acceleration_m_per_s2 "
     "along "
     "the normal.\nStroke evenly for 10 s or more at each force and speed, and at some in between "
     "for --check."},
    {std::nullopt,
     "Everything, one after the other, with a page that says whether the station is ready",
     "Examples:\n  palpa calibrate all --seed 3 --out station3\n      on the virtual bench; then: "
     "palpa subclavian --station station3/station.json --seed 3"}};

void addFiles(CLI::App* command, CalibrateOptions* o) {
  const std::optional<CalibrationKind> kind = o->kind;
  const auto file = [&](const char* name, std::string* where, const char* about) {
    command->add_option(name, *where, about)->type_name("FILE");
  };
  if (kind == CalibrationKind::camera) {
    command->add_option("--images", o->images, "Recorded pictures: a shell pattern, quoted")
        ->type_name("GLOB");
    command->add_option("--board", o->board, "The board in them; otherwise the station's")
        ->type_name("SPEC");
    command->add_flag("--all-corners", o->all_corners,
                      "Plain least squares: no corner is left out");
  }
  if (kind == CalibrationKind::tool) {
    file("--pivot", &o->pivot, "Recorded poses, the tip in a hole");
    file("--spin", &o->spin, "Recorded poses, the needle spun about its axis");
  }
  if (kind == CalibrationKind::workspace)
    file("--touches", &o->touches, "Recorded touches of a grid");
  if (kind == CalibrationKind::registration) {
    file("--landmarks", &o->landmarks, "Recorded touches of landmarks");
    file("--pairs", &o->pairs, "Recorded poses of end effector and tag");
  }
  if (kind == CalibrationKind::latency) {
    file("--camera-track", &o->camera_track, "A point's path as the camera saw it");
    file("--device-track", &o->device_track, "The same as the device saw it");
  }
  if (kind == CalibrationKind::material) file("--presses", &o->presses, "Recorded presses");
  if (kind == CalibrationKind::friction)
    file("--strokes", &o->strokes, "Recorded strokes, to and fro");
  if (kind == CalibrationKind::inclusion) {
    file("--without", &o->without, "Recorded presses of the sample without the lump");
    file("--strokes", &o->strokes, "Recorded strokes of it: for a hand that is not quite still");
    file("--above", &o->above, "Recorded presses above the lump");
    file("--beside", &o->beside, "Recorded presses beside it, and strokes over it");
    file("--check", &o->check, "Recorded presses at another place, to check the result");
    command->add_option("--depth-mm", o->depth_mm, "How deep the lump's middle lies")
        ->check(inRange(1.0, 200.0, "mm"));
    command->add_option("--mockup", o->mockup, "Simulated sample on the virtual bench")
        ->type_name("NAME");
  }
  if (kind == CalibrationKind::object) {
    file("--touches", &o->touches, "Recorded touches, one after the other");
    o->mockup = "growing skin";
    command->add_option("--mockup", o->mockup, "Simulated object on the virtual bench")
        ->type_name("NAME");
  }
  if (kind == CalibrationKind::texture) {
    file("--strokes", &o->strokes, "Recorded strokes, even ones at each force and speed");
    file("--check", &o->check, "Recorded strokes at other forces and speeds, to check the result");
    command->add_option("--mass-g", o->mass_g, "Mass of the tool with its accelerometer")
        ->check(inRange(1.0, 1000.0, "g"));
    command->add_option("--forces", o->forces_N, "Normal forces to make models at, N")
        ->delimiter(',')
        ->check(inRange(0.05, 20.0, "N"))
        ->type_name("N,...");
    command->add_option("--speeds", o->speeds_mm_per_s, "Speeds to make models at, mm/s")
        ->delimiter(',')
        ->check(inRange(10.0, 1000.0, "mm/s"))
        ->type_name("MM/S,...");
    o->surface = "sandpaper";
  }
  if (kind == CalibrationKind::material || kind == CalibrationKind::friction ||
      kind == CalibrationKind::texture)
    command->add_option("--surface", o->surface, "Simulated surface on the virtual bench")
        ->type_name("NAME");
  if (kind == CalibrationKind::force_sensor) {
    file("--readings", &o->readings, "Recorded static readings");
    command->add_option("--down", o->down, "Where weight pulls, in the device's base")
        ->expected(3)
        ->check(aNumber())
        ->type_name("X Y Z");
  }
}

}  // namespace

void addStationCalibrations(CLI::App& calibrate) {
  for (const Routine& routine : kRoutines) {
    const auto o = std::make_shared<CalibrateOptions>();
    o->kind = routine.kind;
    CLI::App* command = calibrate.add_subcommand(o->name(), routine.about);
    command->footer(routine.examples);
    command->add_option("--station", o->station, "Station file; otherwise the virtual bench")
        ->type_name("FILE")
        ->check(somethingThere("stations"));
    command->add_option("--seed", o->seed, "Seed of the virtual bench")->check(atLeastZero());
    command->add_option("--out", o->out, "Folder for the results")->type_name("DIR");
    command->add_flag("--quiet", o->quiet, "No progress");
    command
        ->add_option("--watch", o->watch,
                     "Keep in this JPEG what the camera sees, for a page that shows it; and a line "
                     "for each step")
        ->type_name("FILE");
    addFiles(command, o.get());
    command->callback([o] { calibrateStation(*o); });
  }
}

}  // namespace palpa::cli
