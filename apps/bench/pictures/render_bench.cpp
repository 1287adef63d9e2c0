#include "apps/bench/bench.h"

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/quantile.h"
#include "apps/bench/bench_patients.h"
#include "apps/bench/pictures/plain_scene.h"
#include "apps/bench/pictures/session_frames.h"
#include "apps/bench/pictures/tracking_scene.h"
#include "apps/bench/timing.h"
#include "apps/os/child_process.h"
#include "apps/os/file_access.h"
#include "apps/runtime/clock.h"
#include "apps/trial/picture_writer.h"
#include "ar/tracking/board_tracker.h"
#include "scene/actors/organ_actors.h"
#include "scene/renderer_setup.h"
#include "scene/view/ar_camera.h"
#include "scene/view/scene_view.h"
#include "scene/window/pixels.h"

namespace palpa::bench {
namespace {

using nlohmann::json;
/// The patient alone in one renderer, translucent our way or by peeling.
class Translucent {
 public:
  Translucent(vtkRenderWindow& window, const anatomy::Patient& patient, bool peeling)
      : window_(window) {
    scene::setUpRenderer(*behind_, {0.3, 0.3, 0.3});
    window_.AddRenderer(behind_);
    if (!peeling) glass_ = std::make_unique<scene::Glass>(window_, *behind_);
    organs_ = std::make_unique<scene::OrganActors>(*behind_, patient, glass_.get());
    if (peeling) {
      behind_->UseDepthPeelingOn();
      behind_->SetMaximumNumberOfPeels(100);
      behind_->SetOcclusionRatio(0);
    }
    show(false);
  }
  ~Translucent() {
    organs_.reset();
    glass_.reset();
    window_.RemoveRenderer(behind_);
  }
  void show(bool shown) {
    behind_->SetDraw(shown);
    if (glass_) glass_->renderer().SetDraw(shown);
  }
  void render(const scene::Pinhole& camera, const Pose& X_CA) {
    scene::aim(*behind_->GetActiveCamera(), camera, X_CA, {0.1, 1.5});
    if (glass_) glass_->look(X_CA.inverse().translation());
    show(true);
    window_.Render();
    show(false);
  }

 private:
  vtkRenderWindow& window_;
  vtkNew<vtkRenderer> behind_;
  std::unique_ptr<scene::Glass> glass_;
  std::unique_ptr<scene::OrganActors> organs_;
};

double rmsDifference(const scene::Image& a, const scene::Image& b) {
  double squares = 0;
  std::size_t n = 0;
  for (std::size_t i = 0; i < a.pixels.size(); i += 3) {
    double here = 0;
    bool drawn = false;
    for (std::size_t k = 0; k < 3; ++k) {
      here += std::pow(static_cast<double>(a.pixels[i + k]) - b.pixels[i + k], 2);
      drawn = drawn || a.pixels[i + k] != a.pixels[k] || b.pixels[i + k] != b.pixels[k];
    }
    if (!drawn) continue;
    squares += here / 3;
    ++n;
  }
  return std::sqrt(squares / static_cast<double>(n)) / 255;
}

void printRatio(const std::string& name, const Ratio& ratio, const json& params) {
  print(name, ratio.median, "1", params);
  print(name + "_low", ratio.interval.low, "1", params);
  print(name + "_high", ratio.interval.high, "1", params);
}

void benchTranslucency(vtkRenderWindow& window, const anatomy::Patient& patient, int blocks,
                       json params) {
  const int* size = window.GetSize();
  const double f = 0.9 * size[1];
  const scene::Pinhole camera{size[0], size[1], f, f, size[0] / 2.0, size[1] / 2.0};
  const Vec3 entry_A = patient.landmark(anatomy::landmark::kEntry);
  Translucent ours(window, patient, false), peeled(window, patient, true);
  double worst = 0;
  for (int side = 0; side < 5; ++side) {
    const double round = 0.5 * (side - 2);
    const Pose X_CA = lookAt(entry_A + 0.5 * Vec3(std::sin(round), -std::cos(round), 0.2), entry_A);
    ours.render(camera, X_CA);
    const scene::Image a = scene::pixelsOf(window);
    peeled.render(camera, X_CA);
    worst = std::max(worst, rmsDifference(a, scene::pixelsOf(window)));
  }
  params["views"] = 5;
  print("translucency_rms_to_peeling", worst, "1", params);
  // The eye moves from frame to frame, so that ours sorts anew in each.
  int frame = 0;
  const auto eye = [&] {
    return lookAt(entry_A + Vec3(0.05 * std::sin(0.3 * frame), -0.45, 0.1), entry_A);
  };
  const Ratio ratio = compareQueries(
      blocks, 4,
      [&](int) {
        ++frame;
        peeled.render(camera, eye());
      },
      [&](int) {
        ++frame;
        ours.render(camera, eye());
      });
  printRatio("translucency_cost_over_peeling", ratio, params);
}

/// Our frames beside those of a program that leaves everything to VTK, each in a context of its
/// own.
void benchFrame(const anatomy::Patient& patient, const RenderBenchOptions& options, int blocks,
                scene::SceneView& view, const json& params) {
  SessionFrames frames(patient);
  const auto against = [&](const std::string& name, PlainScene::Translucency translucency,
                           bool fixed_views) {
    const auto context =
        scene::makeGlContext(scene::Display::offscreen, options.width, options.height, "VTK");
    PlainScene plain(*context, patient, {options.width, options.height, translucency, fixed_views});
    plain.show(frames.at(0));
    printRatio(name,
               compareQueries(
                   blocks, 4, [&](int i) { plain.show(frames.at(i)); },
                   [&](int i) { view.show(frames.at(i)); }),
               params);
  };
  against("frame_over_bare_vtk", PlainScene::Translucency::peeling, true);
  against("frame_over_bare_vtk_without_fixed_views", PlainScene::Translucency::peeling, false);
  against("frame_over_vtk_blending", PlainScene::Translucency::blending, true);
}

/// The longest of the frames in which a picture was saved or surfaces were sorted, and of all.
void benchSteadiness(const anatomy::Patient& patient, const RenderBenchOptions& options,
                     scene::SceneView& view, json params) {
  constexpr int kSaveEvery = 150, kMoveEvery = 40;  // frames
  const os::TemporaryFolder folder("palpa-bench-");
  SessionFrames frames(patient);
  trial::PictureWriter writer;
  std::vector<double> all, busy;
  const runtime::SteadyClock clock;
  const double minute_ns = 60.0 * runtime::kSecond;
  int told = 0;
  for (int i = 0; clock.now() < options.minutes * minute_ns || busy.empty(); ++i) {
    const bool save = i % kSaveEvery == kSaveEvery - 1, move = i % kMoveEvery == kMoveEvery - 1;
    if (move) frames.moveEye(i / kMoveEvery % 2 ? 0.01 : 0);
    const scene::SceneState& state = frames.at(i);
    const std::int64_t begin = clock.now();
    view.show(state);
    if (save) writer.write(folder.path() / "view.png", view.capture());
    const double ms = 1e-6 * static_cast<double>(clock.now() - begin);
    all.push_back(ms);
    if (save || move) busy.push_back(ms);
    const int minutes = static_cast<int>(static_cast<double>(clock.now()) / minute_ns);
    if (minutes > told)
      std::fprintf(stderr, "frames: %d of %.0f minutes\n", told = minutes, options.minutes);
  }
  writer.finish();
  const double median = quantile(all, 0.5);
  params["frames"] = all.size();
  params["saved_or_sorted"] = busy.size();
  print("frame", median, "ms", params);
  print("frame_max_over_median", *std::max_element(busy.begin(), busy.end()) / median, "1", params);
  print("frame_max_over_median_of_all", *std::max_element(all.begin(), all.end()) / median, "1",
        params);
}

/// In a process of its own: it may not have drawn before.
void benchHeadsetApart(bool quick) {
  const os::TemporaryFolder folder("palpa-bench-");
  const auto log = folder.path() / "headset.jsonl";
  const int code =
      os::runToEnd({"bench", "headset", "--frames", quick ? "200" : "1000"}, log).exit_code;
  std::ifstream lines(log);
  std::string said;
  std::getline(lines, said);
  if (code != 0 || !said.starts_with('{'))
    throw Error("palpa bench headset ended with " + std::to_string(code),
                said.empty() ? "without a word" : said, "Run it alone");
  std::printf("%s\n", said.c_str());
}

/// What parts of a picture take of the processor: frames with them beside frames without.
void benchCosts(const anatomy::Patient& patient, const RenderBenchOptions& options, int blocks,
                scene::SceneView& view, const json& params) {
  SessionFrames frames(patient);
  const auto print_cost = [&](const char* part, const std::function<void(int)>& without,
                              const std::function<void(int)>& with) {
    const double without_ms = 1e-3 * timeQueries(64, without).median_us;
    json p = params;
    p["part"] = part;
    print("frame_cost", (compareQueries(blocks, 4, without, with).median - 1) * without_ms, "ms",
          p);
  };
  const auto all = [&](int i) { view.show(frames.at(i)); };
  const auto lacking = [&](void (*take)(scene::SceneState&)) {
    return [&frames, &view, take](int i) {
      scene::SceneState state = frames.at(i);
      take(state);
      view.show(state);
    };
  };
  using State = scene::SceneState;
  print_cost("shadow and ring", lacking([](State& s) { s.shadows = false; }), all);
  print_cost("camera's blur and grain", lacking([](State& s) { s.look = {}; }), all);
  print_cost("force arrows", lacking([](State& s) { s.forces.clear(); }), all);
  print_cost("words", lacking([](State& s) { s.hud = {}; }), all);
  const auto sharp = [&](bool smooth) {
    return [&frames, &view, smooth](int i) {
      State state = frames.at(i);
      state.look = {};  // else smoothing is a pass of its own, and what follows differs
      state.smooth_edges = smooth;
      view.show(state);
    };
  };
  print_cost("smooth edges", sharp(false), sharp(true));
  const auto print_layout = [&](const char* part, void (*change)(scene::ViewLayout&)) {
    const auto beside =
        scene::makeGlContext(scene::Display::offscreen, options.width, options.height, "Palpa");
    scene::ViewLayout layout{options.width, options.height};
    change(layout);
    scene::SceneView other(*beside, patient, layout);
    print_cost(part, all, [&](int i) { other.show(frames.at(i)); });
  };
  print_layout("framed on the work", [](scene::ViewLayout& l) { l.framed = true; });
  print_layout("darker creases", [](scene::ViewLayout& l) { l.creases = true; });
}

/// Shares of a frame's time.
void benchShares(const anatomy::Patient& patient, scene::SceneView& view, const json& params) {
  SessionFrames frames(patient);
  const double ours = timeQueries(64, [&](int i) { view.show(frames.at(i)); }).median_us;
  const double capture = timeQueries(16, [&](int) { view.capture(); }).median_us;
  TrackingBenchOptions tracking;
  tracking.width = SessionFrames::kWidth;
  tracking.height = SessionFrames::kHeight;
  const TrackingScene pictures(tracking);
  const cv::Mat picture = pictures.still(TrackingScene::view(0.5, 0.6, 0.4, 0), 0);
  ar::BoardTracker tracker(pictures.board(), pictures.camera());
  std::int64_t t = 0;
  for (int i = 0; i < 10; ++i) tracker.see(picture, t += 33'333'333);
  const double track =
      timeQueries(16, [&](int) { tracker.see(picture, t += 33'333'333); }).median_us;
  print("capture_share", capture / (ours + capture), "1", params);
  print("tracking_share", track / (ours + track), "1", params);
}

}  // namespace

void benchRender(const RenderBenchOptions& options) {
  const anatomy::Patient patient = referenceBust();
  const auto context =
      scene::makeGlContext(scene::Display::offscreen, options.width, options.height, "Palpa");
  const json params{
      {"resolution", std::to_string(options.width) + "x" + std::to_string(options.height)},
      {"triangles", trianglesOf(patient)},
      {"drawn_on", context->describe()}};
  const int blocks = options.quick ? 3 : 11;
  {
    scene::SceneView view(*context, patient, {options.width, options.height});
    benchFrame(patient, options, blocks, view, params);
    benchSteadiness(patient, options, view, params);
    benchCosts(patient, options, blocks, view, params);
    benchShares(patient, view, params);
  }
  benchTranslucency(*context->window(), patient, blocks, params);
  benchHeadsetApart(options.quick);
}

}  // namespace palpa::bench
