#include <cstdio>
#include <cstdlib>
#include <memory>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "apps/cli/arguments.h"
#include "apps/cli/commands.h"
#include "apps/cli/values.h"
#include "apps/doctor/computer_check.h"
#include "apps/doctor/device_check.h"
#include "apps/doctor/picture_facts.h"
#include "apps/doctor/station_check.h"
#include "apps/record/store/delivery.h"
#include "apps/record/store/sql_connection.h"
#include "apps/runtime/clock.h"
#include "apps/session/output_folder.h"
#include "apps/station/assets.h"
#include "apps/twin/setup_bench.h"
#include "ar/cameras/recorded_pictures.h"
#include "ar/cameras/webcam.h"
#include "scene/window/egl_devices.h"
#include "scene/window/gl_context.h"
#include "scene/window/x11_window.h"

namespace palpa::cli {
namespace {

using namespace doctor;

constexpr const char* kMade_utc = "2026-01-01T00:00:00Z";  // no trial is older than this program
constexpr int kPictures = 30;
constexpr std::int64_t kSoundAnswers_ns = 3 * runtime::kSecond;  // a server may have to start

struct DoctorOptions {
  std::string station, records, camera, out = "out";
  std::uint64_t seed = 1;
  double bar_mm = 0;
  bool json = false;
};

/// What the bench's camera sees before anybody does anything.
std::function<std::optional<ar::Frame>()> benchPictures(const station::Station& station,
                                                        std::uint64_t seed) {
  auto bench = std::make_shared<twin::SetupBench>(station, seed);
  return [bench]() -> std::optional<ar::Frame> {
    for (std::optional<runtime::RigMoment> moment = bench->next(); moment; moment = bench->next())
      if (moment->picture) return moment->picture();
    return std::nullopt;
  };
}

/// A source of pictures that is opened where a failure is told.
PictureFacts seenThrough(const std::function<std::unique_ptr<ar::Camera>()>& open,
                         const station::Station& station, const ar::Board& board,
                         const runtime::Clock* clock) {
  std::unique_ptr<ar::Camera> camera;
  PictureFacts facts = lookAt(
      [&] {
        if (!camera) camera = open();
        return camera->grab();
      },
      kPictures, board, station.camera, clock);
  if (const auto* webcam = dynamic_cast<const ar::Webcam*>(camera.get());
      webcam && !webcam->remarks().empty())
    facts.remark = webcam->remarks().front();
  return facts;
}

PictureFacts seenBy(const station::Station& station, const DoctorOptions& o) {
  const std::unique_ptr<ar::Board> board = ar::makeBoard(station.board, station.decimate);
  if (!o.camera.empty())
    return seenThrough(
        [&]() -> std::unique_ptr<ar::Camera> {
          if (ar::isVideoFile(o.camera)) return std::make_unique<ar::VideoFile>(o.camera);
          return std::make_unique<ar::ImageSequence>(o.camera, station.camera_rate_Hz);
        },
        station, *board, nullptr);
  if (station.camera_setup.driver == station::CameraDriver::bench)
    return lookAt(benchPictures(station, o.seed), kPictures, *board, station.camera);
  const station::CameraSetup& setup = station.camera_setup;
  const runtime::SteadyClock clock;
  return seenThrough(
      [&] {
        return std::make_unique<ar::Webcam>(
            ar::WebcamSettings{setup.device, station.camera.width, station.camera.height,
                               station.camera_rate_Hz, setup.exposure_ms, setup.gain, setup.focus});
      },
      station, *board, &clock);
}

void append(Findings& all, const Findings& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// What stands on the table: camera, board, devices, and how they were calibrated.
Findings table(const station::Station& station, const PictureFacts& pictures,
               const DoctorOptions& o) {
  const haptics::DriverDescription* const real = station.device.real;
  Findings all = judgePictures(pictures, station.camera_rate_Hz, station.camera);
  all.push_back(judgePrint(station, o.bar_mm));
  all.push_back(askPedal(station));
  all.push_back(askDevice(station.device));
  append(all, askNeeds(station.device));
  if (real && !real->udev_rule.empty()) all.push_back(askUdevRule(udevFolders(), *real));
  if (real) all.push_back(sayWatchdog(station.device.capabilities));
  all.push_back(askSensor(station));
  if (station.tracker) all.push_back(askTracker(*station.tracker));
  append(all, judgeCalibrations(station, runtime::utcNow()));
  const ClockWatch watch;
  all.push_back(judgeLoop(measureLoop(), real != nullptr));
  all.push_back(judgeClocks(watch.facts(), pictures, record::isServer(o.records)));
  return all;
}

/// Without a home there are none, unless somebody says where.
Finding recordsOf(const DoctorOptions& o) {
  try {
    return askRecords(o.records.empty() ? usualRecords() : o.records,
                      record::PendingList(record::PendingList::usualFolder()).sessions().size());
  } catch (const UsageError& e) {
    return {"records", State::note, e.what(), "Sessions run without records"};
  }
}

doctor::Desktop desktopHere() {
  doctor::Desktop desktop;
  desktop.trouble = scene::whyNoX11();
  desktop.advice = scene::adviceWithoutX11();
  desktop.is_there = std::getenv("DISPLAY") != nullptr || scene::isWaylandAlone();
  if (!desktop.trouble.empty()) return desktop;
  for (const scene::Monitor& one : scene::monitors())
    desktop.monitors.push_back(one.name + ", " + std::to_string(one.width) + "x" +
                               std::to_string(one.height) + (one.primary ? " (primary)" : ""));
  return desktop;
}

std::vector<std::string> graphicsCards() {
  std::vector<std::string> names;
  for (const scene::Gpu& gpu : scene::gpus())
    if (!gpu.on_processor) names.push_back(gpu.name);
  return names;
}

Findings examined(const DoctorOptions& o) {
  Findings all{askAssets()};
  if (canStart(all)) {
    const std::filesystem::path file = o.station.empty()
                                           ? station::assetFile("stations/virtual_bench.json")
                                           : std::filesystem::path(o.station);
    if (const auto station = readStation(file, &all))
      append(all, table(*station, seenBy(*station, o), o));
  }
  all.push_back(judgeDesktop(desktopHere()));
  all.push_back(askDrawing([] {
    const auto context = scene::makeGlContext(scene::Display::automatic, 320, 240, "Palpa: doctor");
    const std::string renderer = context->renderer();
    return doctor::Drawing{context->describe(), renderer, scene::drawsOnProcessor(renderer),
                           graphicsCards()};
  }));
  all.push_back(judgeHeadset(headsetRuntime()));
  all.push_back(judgeSound(sound::askSpeaker(kSoundAnswers_ns)));
  all.push_back(recordsOf(o));
  all.push_back(judgeDisk(measureDisk(o.out)));
  all.push_back(judgeLetters());
  all.push_back(judgeDate(runtime::utcNow(), kMade_utc));
  all.push_back(askLocale());
  return all;
}

void print(const Findings& findings) {
  std::size_t wide = 0, ill = 0, notes = 0;
  for (const Finding& f : findings) {
    wide = std::max(wide, f.subject.size());
    ill += f.state == State::ill;
    notes += f.state == State::note;
  }
  for (const Finding& f : findings) {
    std::printf("%-4s  %-*s  %s\n", name(f.state), static_cast<int>(wide), f.subject.c_str(),
                f.verdict.c_str());
    if (!f.fix.empty()) std::printf("%*s  -> %s\n", static_cast<int>(wide) + 6, "", f.fix.c_str());
  }
  if (ill > 0)
    std::printf("\nNo session can start: see to what is ill (%zu).\n", ill);
  else if (notes > 0)
    std::printf("\nA session can start; %s should be seen to.\n", counted(notes, "thing").c_str());
  else
    std::printf("\nThe station is well.\n");
}

void examine(DoctorOptions o) {
  try {
    if (o.records.empty()) o.records = usualRecords();
  } catch (const UsageError&) {  // no home: said among the findings
  }
  const Findings findings = examined(o);
  if (o.json)
    std::printf("%s\n", toJson(findings).c_str());
  else
    print(findings);
  if (canStart(findings)) return;
  std::string named;
  for (const Finding& f : findings)
    if (f.state == State::ill) named += (named.empty() ? "" : ", ") + f.subject;
  throw Error("no session can start (" + named + ")", "doctor",
              "Follow the advice beside each fault, then run it again");
}

}  // namespace

void addDoctor(CLI::App& program) {
  auto o = std::make_shared<DoctorOptions>();
  CLI::App* command = program.add_subcommand(
      "doctor", "Is this station ready? What is wrong, and what to do about it");
  command->add_option("--station", o->station, "Station file; default: the virtual bench")
      ->type_name("FILE");
  command
      ->add_option("--records", o->records,
                   "Records: a file, or postgresql://user@host/database (default: the usual ones)")
      ->type_name("FILE|URL");
  command
      ->add_option("--camera", o->camera,
                   "Instead of the station's camera: recorded pictures or a film of it")
      ->type_name("GLOB|FILM");
  command->add_option("--bar", o->bar_mm, "Length of the printed board's 100 mm bar by a ruler, mm")
      ->check(inRange(50.0, 200.0, "mm"));
  command->add_option("--out", o->out, "Where results of sessions will go (default out)")
      ->type_name("DIR");
  command->add_option("--seed", o->seed, "Seed of the virtual bench")->check(moreThanZero());
  command->add_flag("--json", o->json,
                    "For programs: {\"can_start\", \"findings\": [{\"subject\", \"state\", "
                    "\"verdict\", \"fix\"}]}");
  command->footer(
      "Exit code 0: a session can start; 1: none can.\n\nExamples:\n  palpa doctor\n  palpa doctor "
      "--station my_station.json --json\n  palpa doctor --station my_station.json --bar 99.8\n  "
      "palpa doctor --station my_station.json --camera 'shots/*.png'");
  command->callback([o] { examine(*o); });
}

}  // namespace palpa::cli
