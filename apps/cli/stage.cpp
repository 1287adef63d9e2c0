#include "apps/cli/stage.h"

namespace palpa::cli {

Stage makeStage(const SessionOptions& options, const anatomy::Patient& patient, bool window,
                bool fixed_views) {
  scene::ViewLayout layout;
  layout.orthographic = fixed_views;
  layout.free_navigation = options.navigation;
  layout.skin_deflection = options.skin_deflection;
  layout.force_colours = options.force_colours;
  layout.stereo = options.stereo;
  layout.inset = options.inset;
  Stage stage;
  stage.context = scene::makeGlContext(window ? scene::Display::window : scene::Display::offscreen,
                                       layout.width, layout.height, "Palpa");
  stage.view = std::make_unique<scene::SceneView>(*stage.context, patient, layout);
  return stage;
}

}  // namespace palpa::cli
