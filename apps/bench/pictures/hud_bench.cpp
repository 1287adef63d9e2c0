#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "anatomy/parametric/phantoms.h"
#include "apps/bench/bench.h"
#include "apps/bench/pictures/session_frames.h"
#include "apps/bench/pictures/tool_outline.h"
#include "apps/bench/timing.h"
#include "apps/evidence/recorded_show.h"
#include "apps/os/child_process.h"
#include "apps/os/file_access.h"
#include "apps/station/assets.h"
#include "apps/station/station_file.h"
#include "apps/training/engine.h"
#include "apps/twin/bench_truth.h"
#include "scene/actors/instrument.h"
#include "scene/view/two_eyes.h"

namespace palpa::bench {
namespace {

using training::Engine;

constexpr int kMoments = 80;        // of a trial
constexpr double kMost = 0.05;      // of the tool
constexpr int kUndisturbed = 8;     // every so many frames the tool is taken away once
constexpr double kMaskWidth = 960;  // px, of what the tool's area is counted in
constexpr double kApart = 0.063, kFocus = 0.5;

struct Window {
  int width, height;
  scene::Stereo stereo = scene::Stereo::none;
};
constexpr std::array<Window, 11> kWindows{{{320, 240},
                                           {640, 360},
                                           {1280, 720},
                                           {400, 900},
                                           {1920, 1080, scene::Stereo::side_by_side},
                                           {3840, 2160},
                                           {1280, 720, scene::Stereo::anaglyph},
                                           {2 * 1832, 1920, scene::Stereo::headset},
                                           {2 * 640, 640, scene::Stereo::headset},
                                           {960, 540, scene::Stereo::top_bottom},
                                           {1024, 768}}};

Engine engineOf(int session) {
  constexpr std::array kTurns{Engine::needle, Engine::palpation, Engine::needle, Engine::search};
  return kTurns[static_cast<std::size_t>(session) % kTurns.size()];
}

std::filesystem::path stationOf(Engine engine) {
  return station::assetFile(engine == Engine::needle      ? "stations/virtual_bench.json"
                            : engine == Engine::palpation ? "stations/palpation_bench.json"
                                                          : "stations/search_bench.json");
}

std::uint64_t seedOf(int session) { return static_cast<std::uint64_t>(session) + 1; }

/// Recorded by the program itself. Its file. Throws Error.
std::filesystem::path record(int session, const std::filesystem::path& folder) {
  const Engine engine = engineOf(session);
  const auto out = folder / std::to_string(session), log = folder / "words.txt";
  std::vector<std::string> arguments{training::commandOf(engine),
                                     "--operator",
                                     session / 4 % 2 ? "novice" : "expert",
                                     "--seed",
                                     std::to_string(seedOf(session)),
                                     "--fast",
                                     "--no-views",
                                     "--quiet",
                                     "--out",
                                     out.string()};
  if (engine == Engine::needle)
    for (const char* word : {"--side", session / 2 % 2 ? "left" : "right", "--handedness",
                             session / 8 % 2 ? "left" : "right"})
      arguments.push_back(word);
  if (const int code = os::runToEnd(arguments, log).exit_code; code != 0)
    throw Error("a session ended with " + std::to_string(code), readWhole(log).value_or(""),
                "Run it alone");
  return out / "session.palpa";
}

/// The patient before the station's camera.
Pose throughCamera(Engine engine, const anatomy::Patient& patient, std::uint64_t seed) {
  const station::Station station = station::readStation(stationOf(engine));
  const Pose X_CW = twin::cameraOnBoom(station, seed);
  if (engine == Engine::needle) return X_CW * station::placePatient(patient, station.entry_W);
  const Pose& X_WP = engine == Engine::search ? station.floor->X_WF : station.sample->X_WP;
  return X_CW * X_WP * anatomy::X_AP().inverse();
}

struct Tally {
  long frames = 0, tip = 0, entry = 0, tool = 0, beyond = 0, alarms = 0;
  double worst = 0;            ///< share of a tool
  long wanted = 0, drawn = 0;  ///< plates, without a tool and with it

  long faults() const { return tip + entry + tool + beyond; }
};

/// A recorded trial shown in one window, and what its words cover.
class Watch {
 public:
  Watch(evidence::RecordedShow& show, const Window& window, const Pose& X_CA, Tally* tally)
      : window_(window),
        X_CA_(X_CA),
        skin_(show.patient()),
        context_(scene::makeGlContext(scene::Display::offscreen, 64, 64, "Palpa, words")),
        view_(*context_, show.patient(), layoutOf(window)),
        replay_(show.on(view_)),
        tally_(tally) {
    replay_->beforeEach([this](scene::SceneState& state) { lookThrough(state); });
  }

  void at(double t_s) {
    show_tool_ = true;
    replay_->show(t_s, "");
    const std::vector<scene::Rect> plates = view_.wordPlates();
    judge(plates);
    if (tally_->frames++ % kUndisturbed) return;
    tally_->drawn += static_cast<long>(plates.size());
    show_tool_ = false;
    replay_->show(t_s, "");
    tally_->wanted += static_cast<long>(view_.wordPlates().size());
  }

 private:
  static scene::ViewLayout layoutOf(const Window& window) {
    scene::ViewLayout layout{window.width, window.height, scene::FixedViews::three, false};
    if (window.stereo == scene::Stereo::headset) layout.fixed_views = scene::FixedViews::none;
    layout.stereo = window.stereo;
    layout.framed = window.stereo != scene::Stereo::headset;
    return layout;
  }

  /// As the session's window has it, in place of a replay's.
  void lookThrough(scene::SceneState& state) {
    state.registered = true;
    state.X_CA = X_CA_;
    state.show_tool = show_tool_;
    state.hud.timeline.reset();
    if (window_.stereo == scene::Stereo::headset)
      state.eyes = scene::stereoPair(eyeOfHeadset(), X_CA_, kApart, kFocus);
    if (show_tool_) shown_ = state;
  }

  scene::Pinhole eyeOfHeadset() const {
    const int width = window_.width / 2, height = window_.height;
    const double f = 0.45 * width;
    return {width, height, f, f, 0.5 * (width - 1), 0.5 * (height - 1)};
  }

  std::vector<scene::ArGeometry> eyes() const {
    if (window_.stereo == scene::Stereo::none) return {view_.arGeometry()};
    return {view_.arGeometry(0), view_.arGeometry(1)};
  }

  void judge(const std::vector<scene::Rect>& plates) {
    tally_->beyond += std::any_of(plates.begin(), plates.end(),
                                  [this](const scene::Rect& plate) { return !isInOneEye(plate); });
    if (shown_.hud.alarm) {
      ++tally_->alarms;  // which are never hidden
      return;
    }
    bool tip = false, entry = false;
    double share = 0;
    for (const scene::ArGeometry& eye : eyes()) {
      tip = tip || covers(plates, pixelOf(eye, shown_.X_AT.translation()));
      if (const auto in_A = entry_A()) entry = entry || covers(plates, pixelOf(eye, *in_A));
      share = std::max(share, coveredShare(plates, eye));
    }
    tally_->tip += tip;
    tally_->entry += entry;
    tally_->tool += share > kMost;
    tally_->worst = std::max(tally_->worst, share);
  }

  bool isInOneEye(const scene::Rect& plate) const {
    const bool headset = window_.stereo == scene::Stereo::headset;
    const int half = window_.width / 2, left = headset && plate.x >= half ? half : 0,
              right = headset && plate.x < half ? half : window_.width;
    return plate.x >= left && plate.right() <= right && plate.y >= 0 &&
           plate.top() <= window_.height;
  }

  /// Where the needle goes through the skin.
  std::optional<Vec3> entry_A() const {
    if (shown_.tool != scene::Tool::needle) return std::nullopt;
    const double length = scene::InstrumentSize().needle_length;
    const Vec3 hub_A = shown_.X_AT * Vec3(0, 0, -length), way = shown_.X_AT.linear().col(2);
    const auto far = skin_.along(hub_A, way, length);
    return far ? std::optional<Vec3>(hub_A + *far * way) : std::nullopt;
  }

  cv::Rect2d fromTop(const scene::Rect& plate) const {
    return {double(plate.x), double(window_.height - plate.top()), double(plate.width),
            double(plate.height)};
  }

  bool covers(const std::vector<scene::Rect>& plates,
              const std::optional<Eigen::Vector2d>& px) const {
    return px && std::any_of(plates.begin(), plates.end(), [&](const scene::Rect& plate) {
             return fromTop(plate).contains(cv::Point2d(px->x(), px->y()));
           });
  }

  double coveredShare(const std::vector<scene::Rect>& plates, const scene::ArGeometry& eye) const {
    const double scale = std::min(1.0, kMaskWidth / window_.width);
    const cv::Mat1b tool = toolOutline(shown_, eye, {window_.width, window_.height}, scale);
    cv::Mat1b under(tool.size(), uchar(0));
    for (const scene::Rect& plate : plates) {
      const cv::Rect2d r = fromTop(plate);
      const cv::Rect small =
          cv::Rect(cv::Rect2d(r.x * scale, r.y * scale, r.width * scale, r.height * scale)) &
          cv::Rect({0, 0}, tool.size());
      tool(small).copyTo(under(small));
    }
    const int all = cv::countNonZero(tool);
    return all ? double(cv::countNonZero(under)) / all : 0;
  }

  Window window_;
  Pose X_CA_;
  SkinRay skin_;
  std::unique_ptr<scene::GlContextProvider> context_;
  scene::SceneView view_;
  std::unique_ptr<replay::TrialReplay> replay_;
  Tally* tally_;
  scene::SceneState shown_;
  bool show_tool_ = true;
};

void watch(int session, const std::filesystem::path& folder, Tally* tally) {
  const std::filesystem::path file = record(session, folder);
  const auto show = evidence::recordedShow(file, 0);
  const Pose X_CA = throughCamera(engineOf(session), show->patient(), seedOf(session));
  Watch watch(*show, kWindows[static_cast<std::size_t>(session) % kWindows.size()], X_CA, tally);
  for (int i = 0; i < kMoments; ++i) watch.at(show->length_s() * i / kMoments);
  std::filesystem::remove_all(file.parent_path());
}

}  // namespace

void benchHud(const HudBenchOptions& options) {
  leaveOutDrawing();
  const os::TemporaryFolder folder("palpa-bench-");
  Tally tally;
  for (int i = 0; i < options.sessions; ++i) {
    const int session = options.first + i;
    const long before = tally.faults();
    watch(session, folder.path(), &tally);
    if (tally.faults() > before)
      std::fprintf(stderr, "hud: in session %d words cover too much of %ld frames\n", session,
                   tally.faults() - before);
    if (i % 10 == 9) std::fprintf(stderr, "hud: %d of %d sessions\n", i + 1, options.sessions);
  }
  const nlohmann::json params{{"sessions", options.sessions},
                              {"frames", tally.frames},
                              {"alarms", tally.alarms},
                              {"windows", kWindows.size()},
                              {"data", "simulated"}};
  const auto count = [&](const char* what, long frames) {
    print(what, static_cast<double>(frames), "frames", params);
  };
  count("hud_over_tip", tally.tip);
  count("hud_over_entry", tally.entry);
  count("hud_over_tool", tally.tool);
  count("hud_beyond_eye", tally.beyond);
  print("hud_tool_covered_max", tally.worst, "1", params);
  print("hud_words_shown", static_cast<double>(tally.drawn) / static_cast<double>(tally.wanted),
        "1", params);
}

}  // namespace palpa::bench
