#pragma once

namespace palpa::bench {

struct HapticsBenchOptions {
  bool quick = false;  ///< two meshes, short strokes, a small height map, to try it out
  int most_triangles = 1'000'000;
};

/// Cost of the tick, fidelity of its force and smoothness at a refresh, over meshes of 1e3 to 1e6
/// triangles: one JSON object a line on standard output. Then the search task's floor
/// (floor_bench.h). The shape is known in closed form and stays with the judge; the tick sees the
/// meshes' snapshots only.
void benchHaptics(const HapticsBenchOptions& options);

}  // namespace palpa::bench
