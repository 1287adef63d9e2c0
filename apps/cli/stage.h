#pragma once

#include <memory>

#include "apps/cli/session_options.h"
#include "scene/scene_view.h"

namespace palpa::cli {

/// What the session is shown on; the view goes before its context.
struct Stage {
  std::unique_ptr<scene::GlContextProvider> context;
  std::unique_ptr<scene::SceneView> view;
};

Stage makeStage(const SessionOptions& options, const anatomy::Patient& patient, bool window,
                bool fixed_views = true);

}  // namespace palpa::cli
