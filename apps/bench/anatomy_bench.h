#pragma once

namespace palpa::bench {

struct AnatomyBenchOptions {
  bool quick = false;  ///< a smaller mesh and few queries, to try it out
};

/// Cost of the geometric questions: closest point on a mesh of 100 000 triangles beside VTK's and
/// Embree's, a needle and a tool's near misses against all organs of the reference patient, the
/// skin's deflection. One JSON object a line.
void benchAnatomy(const AnatomyBenchOptions& options);

}  // namespace palpa::bench
