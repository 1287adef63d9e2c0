#include "apps/session/stage.h"

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "apps/os/file_access.h"
#include "apps/session/session_facts.h"

namespace palpa::session {
namespace {

constexpr int kUsualWidth = 1280, kUsualHeight = 720;
constexpr int kLeastSide_px = 120;

scene::FixedViews fixedViews(const presentation::Presentation& shown) {
  switch (shown.views) {
    case presentation::FixedViews::none:
      return scene::FixedViews::none;
    case presentation::FixedViews::one:
      return scene::FixedViews::one;
    case presentation::FixedViews::three:
      break;
  }
  return scene::FixedViews::three;
}

std::filesystem::path windowFile() {
  return os::stateFolder("Set HOME, or XDG_STATE_HOME to a folder of yours") / "palpa/window.json";
}

/// As it was left last; nothing where nothing was kept, or what was kept makes no sense.
std::optional<scene::WindowPlace> rememberedPlace() {
  try {
    std::ifstream kept(windowFile());
    if (!kept) return std::nullopt;
    const nlohmann::json file = nlohmann::json::parse(kept);
    scene::WindowPlace place{file.at("width"), file.at("height"), file.at("full_screen"),
                             file.at("monitor")};
    if (place.width < kLeastSide_px || place.height < kLeastSide_px) return std::nullopt;
    return place;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

std::string silencesOf(const headset::HeadsetView& view) {
  const int times = view.silences();
  return times == 0 ? ""
                    : "; its runtime did not answer for a while " +
                          (times == 1 ? "once" : std::to_string(times) + " times");
}

}  // namespace

scene::WindowPlace placeOfWindow(const scene::WindowPlace& asked) {
  const std::vector<scene::Monitor> all = scene::monitors();
  scene::WindowPlace place = asked;
  const std::optional<scene::WindowPlace> last = rememberedPlace();
  if (last && asked.width == 0 && !asked.full_screen) {
    place = *last;
    place.monitor = asked.monitor;
  }
  if (all.empty()) return {kUsualWidth, kUsualHeight, false, ""};  // no window can be made
  if (last && asked.monitor.empty())
    for (const scene::Monitor& one : all)
      if (one.name == last->monitor) place.monitor = one.name;
  return scene::fittedTo(scene::monitorOf(place.monitor, all), place);
}

void rememberWindow(const scene::WindowPlace& now) {
  const nlohmann::json file{{"width", now.width},
                            {"height", now.height},
                            {"full_screen", now.full_screen},
                            {"monitor", now.monitor}};
  try {
    std::filesystem::create_directories(windowFile().parent_path());
    writeWhole(windowFile(), file.dump(), Lasts::no);
  } catch (const std::exception&) {  // the next window is as large as usual
  }
}

DesktopStage makeStage(const SessionOptions& options, const anatomy::Patient& patient, bool window,
                       bool fixed_views) {
  const presentation::Presentation shown = shownIn(options);
  scene::ViewLayout layout;
  scene::WindowPlace place{layout.width, layout.height, false, ""};
  layout.fixed_views = fixed_views ? fixedViews(shown) : scene::FixedViews::none;
  layout.inside = shown.anatomy;
  layout.free_navigation = options.navigation && shown.navigation;
  layout.skin_deflection = options.skin_deflection && shown.skin_deflection;
  layout.force_colours = options.force_colours;
  layout.stereo = options.stereo;
  layout.inset = options.inset;
  layout.framed = options.camera.empty();  // recorded pictures are there to see how all of it fits
  if (window) {
    place = placeOfWindow(options.window);
    layout.width = place.width;
    layout.height = place.height;
    layout.text_scale = scene::textScale();
  }
  DesktopStage stage;
  stage.context = scene::makeGlContext(window ? scene::Display::window : scene::Display::offscreen,
                                       place, "Palpa");
  const std::string renderer = stage.context->renderer();
  // Not in an exam: what is near to what shall be felt, on whatever computer it is held.
  layout.creases = !presentation::unaided(shown) && scene::affordsCreases(renderer);
  if (window) stage.renderer = renderer;
  stage.view = std::make_unique<scene::SceneView>(*stage.context, patient, layout);
  return stage;
}

std::vector<report::Fact> drawingFacts(const std::string& renderer,
                                       const std::vector<runtime::Lateness>& lateness) {
  std::vector<report::Fact> facts;
  if (renderer.empty()) return facts;
  for (const runtime::Lateness& late : lateness)
    if (late.name == "scene" && late.steps > 0)
      facts.push_back(
          {"Pictures drawn",
           format("%llu; one takes %.0f ms (median), 99 %% below %.0f ms, the longest "
                  "%.0f ms",
                  static_cast<unsigned long long>(late.steps), 1e-3 * late.cost.median_us,
                  1e-3 * late.cost.p99_us, 1e-3 * late.cost.max_us),
           (scene::drawsOnProcessor(renderer) ? "on the processor, no graphics card: " : "on ") +
               renderer});
  return facts;
}

report::Fact HeadStage::fact() const {
  if (!view) return {"Headset", "none", refusal};
  return {"Headset", view->describe(),
          std::to_string(view->frames()) + " pictures shown to each eye" + silencesOf(*view) +
              (view->trouble().empty() ? "" : "; then " + view->trouble())};
}

HeadStage makeHeadStage(const SessionOptions& options, const anatomy::Patient& patient,
                        const Pose& X_WA, const DesktopStage& desktop) {
  HeadStage stage;
  if (!options.headset) return stage;
  headset::HeadsetViewSetup setup;
  setup.X_WA = X_WA;
  setup.focus_A = patient.landmark(anatomy::landmark::kEntry);
  setup.left_handed = options.left_handed;
  setup.force_colours = options.force_colours;
  const presentation::Presentation shown = shownIn(options);
  setup.skin_deflection = options.skin_deflection && shown.skin_deflection;
  setup.inside = shown.anatomy;
  try {
    stage.view = std::make_unique<headset::HeadsetView>(patient, std::move(setup));
    if (desktop.context) desktop.context->neverWait();
  } catch (const Error& error) {
    if (options.who == OperatorKind::person && options.display != scene::Display::window) throw;
    stage.refusal = error.what();
    std::fprintf(stderr, "palpa: %s; the session continues on the desktop\n", error.what());
  }
  return stage;
}

}  // namespace palpa::session
