#pragma once

#include <memory>

#include "apps/cli/needle_world.h"
#include "scene/scene_view.h"

namespace palpa::cli {

/// What the session is shown on; the view goes before its context.
struct Stage {
  std::unique_ptr<scene::GlContextProvider> context;
  std::unique_ptr<scene::SceneView> view;
};

Stage makeStage(const SessionOptions& options, const NeedleWorld& world, bool window);

}  // namespace palpa::cli
