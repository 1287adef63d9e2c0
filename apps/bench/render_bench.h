#pragma once

namespace palpa::bench {

struct RenderBenchOptions {
  int width = 1280, height = 720;
  bool quick = false;  ///< fewer blocks
};

/// What our frame costs beside VTK's own of the same actors, where its time goes, and translucent
/// surfaces beside depth peeling. One JSON object a line. Throws Error where nothing can be drawn.
void benchRender(const RenderBenchOptions& options);

}  // namespace palpa::bench
