#include "anatomy/base/error.h"
#include "apps/bench/bench.h"
#include "apps/bench/pictures/tracking_fit.h"
#include "apps/cli/arguments.h"
#include "apps/cli/commands.h"
#include "apps/cli/values.h"
#include "apps/session/terminal.h"

namespace palpa::cli {
namespace {

void addHaptics(CLI::App& bench) {
  CLI::App* haptics =
      bench.add_subcommand("haptics", "Cost of the tick, fidelity and smoothness of its force");
  haptics->footer("Example:\n  palpa bench haptics > haptics.jsonl\n  palpa bench haptics --quick");
  const auto options = std::make_shared<bench::HapticsBenchOptions>();
  haptics->add_flag("--quick", options->quick, "Small meshes and short strokes");
  haptics->add_option("--most-triangles", options->most_triangles, "Leave out larger meshes")
      ->check(inRange(1000, 1'000'000));
  haptics->callback([options] { bench::benchHaptics(*options); });
}

void addLoop(CLI::App& bench) {
  CLI::App* loop = bench.add_subcommand(
      "loop", "Lateness of the haptic loop beside a bare timer loop, under load");
  loop->footer(
      "Example:\n  palpa bench loop > loop.jsonl\n  palpa bench loop --rate 4000 --cpu 1\n  palpa "
      "bench loop --pages 2\n      the same again while two pages of the console watch");
  const auto options = std::make_shared<bench::LoopBenchOptions>();
  loop->add_option("--seconds", options->seconds, "Duration of the measurement, in 40 segments")
      ->check(inRange(1.0, 3600.0, "s"));
  loop->add_option("--rate", options->rate_Hz, "Ticks per second")
      ->check(inRange(1000.0, 4000.0, "a second"));
  loop->add_option("--cpu", options->cpu, "Keep the measured thread on this processor")
      ->check(inRange(0, 1023));
  loop->add_option("--pages", options->pages,
                   "Measure again while this many pages of the console are open")
      ->check(inRange(0, 8));
  loop->callback([options] { bench::benchLoop(*options); });
}

void addAnatomy(CLI::App& bench) {
  CLI::App* anatomy = bench.add_subcommand(
      "anatomy",
      "Cost of geometric queries and of the skin's deflection, compared with other libraries");
  anatomy->footer("Example:\n  palpa bench anatomy > anatomy.jsonl\n  palpa bench anatomy --quick");
  const auto options = std::make_shared<bench::AnatomyBenchOptions>();
  anatomy->add_flag("--quick", options->quick, "A smaller mesh and few queries");
  anatomy->callback([options] { bench::benchAnatomy(*options); });
}

void addCalibration(CLI::App& bench) {
  CLI::App* calibration = bench.add_subcommand(
      "calibration", "How close the estimators come to what the data permit (simulated data)");
  calibration->footer(
      "Example:\n  palpa bench calibration > calibration.jsonl\n  palpa bench calibration --sets "
      "50");
  const auto options = std::make_shared<bench::CalibrationBenchOptions>();
  calibration
      ->add_option("--sets", options->sets, "Synthetic sets for each estimator (default 500)")
      ->check(inRange(10, 100'000));
  calibration->callback([options] { bench::benchCalibration(*options); });
}

void addMaterial(CLI::App& bench) {
  CLI::App* material = bench.add_subcommand("material",
                                            "How accurate rendered stiffness, friction, squeezing "
                                            "and virtual lumps are (simulated phantoms)");
  material->footer(
      "Example:\n  palpa bench material > material.jsonl\n  palpa bench material --quick");
  const auto options = std::make_shared<bench::MaterialBenchOptions>();
  material->add_flag("--quick", options->quick,
                     "Without noise only, three of the mock-ups and two of the hands");
  material->callback([options] { bench::benchMaterial(*options); });
}

void addObject(CLI::App& bench) {
  CLI::App* object =
      bench.add_subcommand("object",
                           "How true a map of stiffness is that is learnt by touch, and whether it "
                           "knows its error (simulated objects)");
  object->footer("Example:\n  palpa bench object > object.jsonl\n  palpa bench object --seeds 2");
  const auto options = std::make_shared<bench::ObjectBenchOptions>();
  object->add_option("--seeds", options->seeds, "Simulated hands for each object (default 50)")
      ->check(inRange(1, 10'000));
  object->callback([options] { bench::benchObject(*options); });
}

void addRecordsBench(CLI::App& bench) {
  CLI::App* records = bench.add_subcommand(
      "records", "Time and memory of a cohort's page and of an export (simulated trials)");
  records->footer(
      "Example:\n  palpa bench records > records.jsonl\n  palpa bench records --trials 1000\n  "
      "palpa bench records --records postgresql://palpa@localhost/bench\n      an empty database, "
      "in which the simulated trials stay");
  const auto options = std::make_shared<bench::RecordsBenchOptions>();
  records->add_option("--records", options->records,
                      "An empty database or a new file; default: a file that passes");
  records
      ->add_option("--trials", options->trials,
                   "How many, in hundreds; several one after the other, the records growing "
                   "(default 1000,10000,100000)")
      ->delimiter(',')
      ->type_name("NUMBER,...")
      ->check(inRange(100, 1'000'000));
  records->callback([options] { bench::benchRecords(*options); });
}

void addRenderBench(CLI::App& bench) {
  CLI::App* render = bench.add_subcommand(
      "render",
      "Cost of a frame beside VTK's own, and of translucent surfaces beside depth peeling");
  render->footer(
      "Example:\n  palpa bench render > render.jsonl\n  palpa bench render --quick --minutes 0.5 "
      "--width "
      "1920 --height 1080");
  const auto options = std::make_shared<bench::RenderBenchOptions>();
  render->add_option("--width", options->width, "Width of the window, px")
      ->check(inRange(320, 4096));
  render->add_option("--height", options->height, "Height of the window, px")
      ->check(inRange(240, 4096));
  render
      ->add_option("--minutes", options->minutes,
                   "Frames for so long, a picture saved or surfaces sorted now and then")
      ->check(inRange(0.01, 600.0));
  render->add_flag("--quick", options->quick, "Fewer repetitions; --minutes 10 takes as long");
  addGpuArgument(*render);
  render->callback([options] { bench::benchRender(*options); });
}

void addHeadsetBench(CLI::App& bench) {
  CLI::App* headset = bench.add_subcommand(
      "headset", "What a headset's frame costs the processor, with everything but the drawing");
  headset->footer("Example:\n  palpa bench headset\n  palpa bench headset --frames 100");
  const auto options = std::make_shared<bench::HeadsetBenchOptions>();
  headset->add_option("--frames", options->frames, "Frames (default 1000)")
      ->check(inRange(1, 1'000'000));
  headset->callback([options] { bench::benchHeadset(*options); });
}

void addObserver(CLI::App& bench) {
  CLI::App* observer = bench.add_subcommand("observer",
                                            "What can be read from one AR view: a program that "
                                            "gets only its pixels tells how far off the "
                                            "skin a needle is, and how deep");
  observer->footer(
      "Example:\n  palpa bench observer > observer.jsonl\n  palpa bench observer --poses 20");
  const auto options = std::make_shared<bench::ObserverBenchOptions>();
  observer
      ->add_option("--poses", options->poses,
                   "Poses before the puncture, and after it (default 200)")
      ->check(inRange(1, 100'000));
  observer->callback([options] { bench::benchObserver(*options); });
}

void addHud(CLI::App& bench) {
  CLI::App* hud = bench.add_subcommand(
      "hud", "Whether words cover tip, entry or tool, over recorded sessions of both hands");
  hud->footer("Example:\n  palpa bench hud > hud.jsonl\n  palpa bench hud --first 37 --sessions 1");
  const auto options = std::make_shared<bench::HudBenchOptions>();
  hud->add_option("--first", options->first, "The first of them: to look at one again")
      ->check(inRange(0, 1'000'000));
  hud->add_option("--sessions", options->sessions, "Sessions (default 200)")
      ->check(inRange(1, 100'000));
  hud->callback([options] { bench::benchHud(*options); });
}

void addRoomBench(CLI::App& bench) {
  CLI::App* room = bench.add_subcommand(
      "room",
      "What a room of 20 stations costs a session, and whether the room hears every event once");
  room->footer(
      "Examples:\n  palpa bench room > room.jsonl\n  palpa bench room --quick\n  palpa bench room "
      "--records postgresql://palpa@localhost/bench\n      an empty database, in which the "
      "simulated trials stay");
  const auto options = std::make_shared<bench::RoomBenchOptions>();
  room->add_option("--stations", options->stations, "With the one that is measured (default 20)")
      ->check(inRange(2, 100));
  room->add_option("--blocks", options->blocks,
                   "Of four sessions each: in the room, twice alone, in the room (default 6)")
      ->check(inRange(1, 1000));
  room->add_option("--seconds", options->seconds, "Of each session (default 20)")
      ->check(inRange(2.0, 3600.0, "s"));
  room->add_option("--records", options->records,
                   "An empty database or a new file; default: a file that passes");
  const auto quick = std::make_shared<bool>(false);
  room->add_flag("--quick", *quick, "4 stations, one block of 8 s, to try it out");
  room->callback([options, quick] {
    if (*quick) *options = {4, 1, 8, options->records};
    bench::benchRoom(*options);
  });
}

void addSession(CLI::App& bench) {
  CLI::App* session = bench.add_subcommand(
      "session", "How many times real time a simulated session runs, how soon it starts, and why");
  session->footer(
      "Example:\n  palpa bench session > session.jsonl\n  palpa bench session --trials 10 "
      "--tracking model");
  const auto options = std::make_shared<bench::SessionBenchOptions>();
  session->add_option("--trials", options->trials, "Trials of the session (default 4)")
      ->check(inRange(1, 1000));
  session->add_option("--seed", options->seed, "Seed of the first trial (default 1)")
      ->check(atLeastZero());
  CLI::Option* views = session->add_flag("--views", options->views, "With pictures of the scene");
  session
      ->add_option("--tracking", options->tracking,
                   "Only with the board tracked like this (default: in pictures, then by a model "
                   "of them)")
      ->check(oneOf({"images", "model"}))
      ->type_name("images|model")
      ->excludes(views);
  session->callback([options] { bench::benchSession(*options); });
}

void addStop(CLI::App& bench) {
  CLI::App* stop = bench.add_subcommand(
      "stop",
      "Milliseconds from the emergency stop to zero force, while a part of a session hangs");
  stop->footer(
      "Example:\n  palpa bench stop > stop.jsonl\n  palpa bench stop --presses 20\n      15 lines: "
      "by key, signal and console; while scene, task, recorder, camera or nothing hangs");
  const auto options = std::make_shared<bench::StopBenchOptions>();
  stop->add_option("--presses", options->presses, "Presses for each line (default 200)")
      ->check(inRange(1, 100'000));
  stop->callback([options] { bench::benchStop(*options); });
}

/// The tracking model's part of `bench tracking`.
struct TrackingModelArguments {
  bench::TrackingFitOptions fit;
  bool compare = false;
  bench::TrackingModelOptions model;
};

std::shared_ptr<TrackingModelArguments> addTrackingModel(CLI::App& tracking) {
  auto o = std::make_shared<TrackingModelArguments>();
  CLI::Option* fit =
      tracking
          .add_option("--fit", o->fit.file,
                      "Measure the errors of poses from pictures, for sessions with --tracking "
                      "model, and write the figures to this file")
          ->type_name("FILE");
  CLI::Option* compare =
      tracking.add_flag("--model", o->compare, "Compare that model with pictures of other seeds");
  fit->excludes(compare);
  tracking
      .add_option("--station", o->fit.station,
                  "With --fit or --model: station file (default: the virtual bench)")
      ->type_name("FILE")
      ->check(somethingThere("stations"));
  tracking
      .add_option("--sessions", o->model.sessions,
                  "With --model: sessions of 3 s, by each (default 800)")
      ->needs(compare)
      ->check(inRange(1, 100'000));
  return o;
}

void runTrackingModel(TrackingModelArguments& o) {
  constexpr int kParts = 1000;
  session::WorkProgress progress(o.compare ? "comparing" : "measuring", kParts);
  const auto done = [&](double share) { progress.done(static_cast<int>(share * kParts)); };
  o.fit.done = o.model.done = done;
  o.model.station = o.fit.station;
  if (o.compare)
    bench::benchTrackingModel(o.model);
  else
    bench::fitTrackingModel(o.fit);
}

void addTracking(CLI::App& bench) {
  CLI::App* tracking = bench.add_subcommand(
      "tracking", "How accurate, steady and fast the board's tracking is (simulated pictures)");
  tracking->footer(
      "Examples:\n  palpa bench tracking > tracking.jsonl\n  palpa bench tracking --distance 1 "
      "--speed 0.1 --quick\n  palpa bench tracking --fit tracking.json\n  palpa bench tracking "
      "--model --sessions 50");
  const auto options = std::make_shared<bench::TrackingBenchOptions>();
  tracking->add_option("--distance", options->distance, "From camera to board, m")
      ->check(inRange(0.2, 3.0, "m"));
  tracking->add_option("--speed", options->speed, "Peak speed of the motion, m/s")
      ->check(inRange(0.01, 2.0, "m/s"));
  tracking
      ->add_option("--horizon", options->horizon_ms,
                   "From an exposure to when its pose is drawn, ms")
      ->check(inRange(0.0, 200.0, "ms"));
  tracking->add_option("--width", options->width, "Width of the picture, px")
      ->check(inRange(320, 4096));
  tracking->add_option("--height", options->height, "Height of the picture, px")
      ->check(inRange(240, 4096));
  tracking->add_option("--rate", options->rate_Hz, "Pictures per second")
      ->check(inRange(5.0, 240.0, "a second"));
  tracking->add_option("--seed", options->seed, "Seed of the simulated noise")
      ->check(atLeastZero());
  const std::vector<CLI::Option*> of_tracking = tracking->get_options();
  CLI::Option* const quick =
      tracking->add_flag("--quick", options->quick, "A tenth of the pictures");
  const auto model = addTrackingModel(*tracking);
  for (const char* name : {"--fit", "--model"})
    for (CLI::Option* other : of_tracking)
      if (other != tracking->get_help_ptr()) tracking->get_option(name)->excludes(other);
  tracking->get_option("--model")->excludes(quick);
  tracking->callback([options, model] {
    if (model->fit.file.empty() && !model->compare) {
      if (!model->fit.station.empty())
        throw UsageError("goes with --fit or --model", "--station", "Add one of them");
      return bench::benchTracking(*options);
    }
    model->fit.quick = options->quick;
    runTrackingModel(*model);
  });
}

}  // namespace

void addBench(CLI::App& program) {
  CLI::App* bench = program.add_subcommand("bench", "Measurements, one JSON object a line");
  bench->require_subcommand(1);
  bench->footer(
      "Examples:\n  palpa bench haptics > haptics.jsonl\n  palpa bench loop --rate 4000 --cpu 1\n  "
      "palpa bench stop --presses 20");
  addAnatomy(*bench);
  addCalibration(*bench);
  addHaptics(*bench);
  addLoop(*bench);
  addMaterial(*bench);
  addObject(*bench);
  addRecordsBench(*bench);
  addRenderBench(*bench);
  addHeadsetBench(*bench);
  addHud(*bench);
  addObserver(*bench);
  addRoomBench(*bench);
  addSession(*bench);
  addStop(*bench);
  addTracking(*bench);
}

}  // namespace palpa::cli
