#include "apps/session/stage.h"

#include <cstdio>

#include "anatomy/base/error.h"

namespace palpa::session {
namespace {

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

std::string silencesOf(const headset::HeadsetView& view) {
  const int times = view.silences();
  return times == 0 ? ""
                    : "; its runtime did not answer for a while " +
                          (times == 1 ? "once" : std::to_string(times) + " times");
}

}  // namespace

DesktopStage makeStage(const SessionOptions& options, const anatomy::Patient& patient, bool window,
                       bool fixed_views) {
  const presentation::Presentation shown = shownIn(options);
  scene::ViewLayout layout;
  layout.fixed_views = fixed_views ? fixedViews(shown) : scene::FixedViews::none;
  layout.inside = shown.anatomy;
  layout.free_navigation = options.navigation && shown.navigation;
  layout.skin_deflection = options.skin_deflection && shown.skin_deflection;
  layout.force_colours = options.force_colours;
  layout.stereo = options.stereo;
  layout.inset = options.inset;
  layout.framed = options.camera.empty();  // recorded pictures are there to see how all of it fits
  DesktopStage stage;
  stage.context = scene::makeGlContext(window ? scene::Display::window : scene::Display::offscreen,
                                       layout.width, layout.height, "Palpa");
  stage.view = std::make_unique<scene::SceneView>(*stage.context, patient, layout);
  return stage;
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
