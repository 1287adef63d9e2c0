#include "apps/cli/head_stage.h"

#include <cstdio>

#include "anatomy/geometry/error.h"

namespace palpa::cli {

SessionDevices::Fact HeadStage::fact() const {
  if (!view) return {"Headset", "none", refusal};
  return {"Headset", view->describe(),
          std::to_string(view->frames()) + " pictures shown to each eye" +
              (view->trouble().empty() ? "" : "; then " + view->trouble())};
}

HeadStage makeHeadStage(const SessionOptions& options, const NeedleWorld& world,
                        const Stage& desktop) {
  HeadStage stage;
  if (!options.headset) return stage;
  headset::HeadsetView::Setup setup;
  setup.X_WA = world.X_WA;
  setup.focus_A = world.patient.landmark(anatomy::landmark::kEntry);
  setup.left_handed = options.left_handed;
  setup.force_colours = options.force_colours;
  setup.skin_deflection = options.skin_deflection;
  try {
    stage.view = std::make_unique<headset::HeadsetView>(world.patient, std::move(setup));
    if (desktop.context) desktop.context->neverWait();
  } catch (const Error& error) {
    if (options.who == OperatorKind::person && options.display != scene::Display::window) throw;
    stage.refusal = error.what();
    std::fprintf(stderr, "palpa: %s; the session goes on on the desktop\n", error.what());
  }
  return stage;
}

}  // namespace palpa::cli
