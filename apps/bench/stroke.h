#pragma once

#include <vector>

#include "anatomy/local_geometry_builder.h"
#include "haptics/tick.h"

namespace palpa::bench {

/// A probe led over the torso: x = 40 mm sin(2 pi f t), y = 25 mm sin(2 pi 0.31 f t + 0.5), its
/// point `depth` under the surface along the normal.
struct StrokeSettings {
  double stroke_Hz = 0.2;
  double geometry_Hz = 60;
  double seconds = 10;
  double depth = 0.001;
  double stiffness = 500;  ///< of the tissue, N/m
  double coupling = 1000;  ///< K_c, N/m
};

Vec3 strokePoint(const StrokeSettings& settings, double t_s);
haptics::TickConfig strokeConfig(const StrokeSettings& settings);

/// What came out of a stroke in virtual time: the real activities HAPTIC and GEOMETRY on a device
/// that is moved.
struct StrokeResult {
  std::vector<haptics::FlightRecord> records;
  std::vector<LocalGeometry> snapshots;  ///< in order; snapshot number n is at n - 1
};
StrokeResult runStroke(const StrokeSettings& settings,
                       const anatomy::LocalGeometryBuilder& builder);

}  // namespace palpa::bench
