#include "apps/cli/commands.h"

#include <cmath>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "apps/cli/arguments.h"
#include "apps/cli/values.h"
#include "apps/evidence/recorded_show.h"
#include "apps/evidence/search_figures.h"
#include "apps/live/port.h"
#include "apps/os/signals.h"
#include "apps/replay/film.h"
#include "apps/replay/player.h"
#include "apps/runtime/clock.h"
#include "apps/session/output_folder.h"
#include "apps/session/stage.h"
#include "apps/session/terminal.h"

namespace palpa::cli {
namespace {

constexpr int kPictureQuality = 85;

struct ShownSize {
  int width = 0, height = 0;
};

ShownSize sizeOf(const std::string& text) {
  ShownSize size;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &rest) != 2 ||
      size.width < 160 || size.height < 120 || size.width > 7680 || size.height > 4320 ||
      size.width % 2 || size.height % 2)
    throw UsageError("is not a film size", "--size " + text,
                     "Write it as 1280x720: even numbers, 160x120 to 7680x4320");
  return size;
}

const char* toneName(scene::TickTone tone) {
  constexpr const char* kNames[] = {"neutral", "good", "guide", "bad"};
  return kNames[static_cast<std::size_t>(tone)];
}

struct Cut {
  double from_s = 0, to_s = 0;
};

Cut cutOf(const ReplayViewOptions& o, double length_s) {
  const Cut cut{o.from_s, o.to_s < 0 ? length_s : std::min(o.to_s, length_s)};
  if (!(cut.from_s >= 0 && cut.from_s < cut.to_s)) {
    char length[32];
    std::snprintf(length, sizeof length, "%.1f s", length_s);
    throw UsageError("leave nothing to show", "--from and --to",
                     std::string("The trial lasts ") + length);
  }
  return cut;
}

struct ReplayStage {
  std::unique_ptr<scene::GlContextProvider> context;
  std::unique_ptr<scene::SceneView> view;
};

ReplayStage stageFor(const evidence::RecordedShow& recorded, scene::Display display,
                     const scene::WindowPlace& place) {
  ReplayStage stage;
  stage.context = scene::makeGlContext(display, place, "Palpa: replay");
  scene::ViewLayout layout;
  layout.width = place.width;
  layout.height = place.height;
  if (stage.context->interactive()) layout.text_scale = scene::textScale();
  layout.fixed_views = recorded.fixedViews() ? scene::FixedViews::three : scene::FixedViews::none;
  layout.creases = scene::affordsCreases(stage.context->renderer());
  if (recorded.pictures()) layout.inset = scene::Inset::camera;
  stage.view = std::make_unique<scene::SceneView>(*stage.context, recorded.patient(), layout);
  return stage;
}

void playInWindow(evidence::RecordedShow& recorded, const Cut& cut, const ReplayViewOptions& o) {
  const ReplayStage stage =
      stageFor(recorded, scene::Display::window, session::placeOfWindow(o.window));
  const std::unique_ptr<replay::TrialReplay> shown = recorded.on(*stage.view);
  replay::Player player(cut.from_s, cut.to_s, o.speed);
  std::printf(
      "space: pause; Left, Right: 1 s; with shift: a frame; + and -: speed; F11: full screen; "
      "Escape: leave\n");
  constexpr std::int64_t kFrame_ns = 33'333'333;
  const runtime::SteadyClock clock;
  for (std::int64_t last_ns = clock.now(); !player.left() && !shown->input().closed;) {
    const std::int64_t now_ns = clock.now();
    player.advance(static_cast<double>(now_ns - last_ns) * 1e-9);
    last_ns = now_ns;
    shown->show(player.at_s(), player.words());
    const scene::ViewInput& input = shown->input();
    for (std::size_t i = 0; i < input.keys.size(); ++i)
      player.key(input.keys[i], input.typed[i], input.shift);
    clock.sleepUntil(now_ns + kFrame_ns);
  }
}

/// Draws picture after picture of the cut.
void draw(evidence::RecordedShow& recorded, const Cut& cut, const ReplayViewOptions& o,
          const std::function<void(int number, const scene::Image&)>& keep) {
  const ShownSize size = sizeOf(o.size);
  const ReplayStage stage =
      stageFor(recorded, scene::Display::offscreen, {size.width, size.height, false, ""});
  const std::unique_ptr<replay::TrialReplay> shown = recorded.on(*stage.view);
  const int frames = std::max(
      1, static_cast<int>(std::lround((cut.to_s - cut.from_s) / o.speed * o.frames_per_second)));
  replay::Player speed(cut.from_s, cut.to_s, o.speed);
  session::WorkProgress progress("pictures", frames);
  const os::InterruptNote interrupt;
  for (int i = 0; i < frames; ++i) {
    if (interrupt.noted())
      throw Error("was interrupted: nothing is written", o.video.empty() ? o.pictures : o.video,
                  "Start again, or take a part of the trial: --from, --to");
    shown->show(cut.from_s + i * o.speed / o.frames_per_second, speed.words());
    keep(i, stage.view->capture());
    progress.done(i + 1);
  }
}

void writeFilm(evidence::RecordedShow& recorded, const Cut& cut, const ReplayViewOptions& o) {
  const ShownSize size = sizeOf(o.size);
  replay::codecOf(o.video);  // refused before the scene is made
  replay::Film film(o.video, o.frames_per_second, size.width, size.height);
  draw(recorded, cut, o, [&](int, const scene::Image& picture) { film.add(picture); });
  film.finish();
  std::printf("Written: %s (%s, %.1f s)\n", o.video.c_str(),
              counted(film.frames(), "picture").c_str(), film.frames() / o.frames_per_second);
}

/// Beside the pictures stands what they show: first, for it is there at once, where a needle went;
/// last, so that with it they are complete, length, rate, and what happened when.
void writePictures(evidence::RecordedShow& recorded, const Cut& cut, const ReplayViewOptions& o) {
  session::OutputFolder output(o.pictures, "pictures");
  const std::filesystem::path& folder = output.path();
  if (const nlohmann::json track = recorded.track(); !track.is_null())
    writeWhole(folder / "track.json", track.dump() + "\n", Lasts::no);
  int count = 0;
  draw(recorded, cut, o, [&](int number, const scene::Image& picture) {
    char name[32];
    std::snprintf(name, sizeof name, "picture-%05d.jpg", number);
    writeWhole(folder / name, live::jpegOf(picture, kPictureQuality), Lasts::no);
    count = number + 1;
  });
  nlohmann::json told{{"from_s", cut.from_s},
                      {"length_s", recorded.length_s()},
                      {"pictures_per_second", o.frames_per_second / o.speed},
                      {"pictures", count},
                      {"marks", nlohmann::json::array()}};
  for (const replay::StripMark& mark : recorded.marks())
    told["marks"].push_back({{"t_s", mark.t_s},
                             {"tone", toneName(mark.tone)},
                             {"text", mark.words},
                             {"near_miss", mark.near_miss}});
  writeWhole(folder / "pictures.json", told.dump(1) + "\n");
  output.keep();
  std::printf("Written: %s (%s, and pictures.json: what happened when)\n", folder.c_str(),
              counted(count, "picture").c_str());
}

}  // namespace

void addReplayViewOptions(CLI::App& command, ReplayViewOptions& o) {
  command.add_flag("--view", o.view,
                   "Show a trial in the scene, in a window: space pauses, arrows step, + and - "
                   "change the speed, Escape leaves");
  command.add_option("--video", o.video, "Write it as a film instead (.mp4, .avi)")
      ->type_name("FILE");
  command
      .add_option(
          "--pictures", o.pictures,
          "Write single pictures into this folder (JPEG), and what happened when (pictures.json)")
      ->type_name("DIR");
  command
      .add_option(
          "--figures", o.figures,
          "Of a search: draw the floor's stimulus, texture, the edge filter and the response "
          "to it, and the probe's way over it, into this folder (SVG, and figures.html)")
      ->type_name("DIR");
  command.add_option("--trial", o.trial, "Which trial; default: the first that was finished")
      ->check(inRange(1, 100000));
  command.add_option("--speed", o.speed, "1: as fast as recorded")
      ->check(inRange(replay::kSlowest, replay::kFastest));
  command.add_option("--from", o.from_s, "Second of the trial to start at")
      ->check(notNegative("s"));
  command.add_option("--to", o.to_s, "Second of the trial to stop at; default: its end")
      ->check(notNegative("s"));
  command.add_option("--fps", o.frames_per_second, "Pictures per second")
      ->check(inRange(1.0, 120.0, "a second"));
  command
      .add_option_function<std::string>(
          "--show-map", [&o](const std::string& text) { o.show_map = text == "on"; },
          "Draw the learnt map of what is felt, where the session has one (default on); off: what "
          "was felt, instead")
      ->check(oneOf({"on", "off"}))
      ->type_name("on|off");
  command.add_option("--size", o.size, "Size of the pictures, pixels")->type_name("WxH");
  addWindowArguments(command, o.window);
  addGpuArgument(command);
}

void writeReplayFigures(const std::string& file, const ReplayViewOptions& o) {
  const record::SessionReader reader(file);
  const report::SearchFigures figures = evidence::searchFigures(reader, o.trial);
  session::OutputFolder output(o.figures, "figures");
  const std::vector<std::string> names = report::writeFigureFiles(figures, output.path());
  output.keep();
  std::printf("Written: %s (episode %d: figures.html, and %s)\n", output.path().c_str(),
              figures.trial, counted(names.size() - 1, "picture").c_str());
}

void viewReplay(const std::string& file, const ReplayViewOptions& o) {
  const std::unique_ptr<evidence::RecordedShow> recorded = evidence::recordedShow(file, o.trial);
  const Cut cut = cutOf(o, recorded->length_s());
  if (!o.show_map) recorded->hideMap();
  if (o.view)
    playInWindow(*recorded, cut, o);
  else if (!o.video.empty())
    writeFilm(*recorded, cut, o);
  else
    writePictures(*recorded, cut, o);
}

}  // namespace palpa::cli
