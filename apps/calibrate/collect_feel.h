#pragma once

#include <filesystem>
#include <string>

#include "apps/calibrate/collect.h"

namespace palpa::calibrate {

/// Where the tip is put on the sample, m across P, and what for.
struct FeltPlace {
  double across = 0, along = 0;
};

/// Pressed slowly and quickly, at one place; `sample` as in a Request. Throws Error, and UsageError
/// for a station without force sensor or sample.
FeltSamples collectPresses(const Scene& scene, const std::string& sample, const FeltPlace& place,
                           double seconds);
/// Stroked to and fro over the middle.
FeltSamples collectStrokes(const Scene& scene, const std::string& sample, double seconds);

/// A table: t_s; x_, y_, z_ (m or mm) of the tip's lowest point, z up from the sample's top;
/// force_x_N, ...; optional lump_x_, .... Times must be even. Throws Error.
FeltSamples readFelt(const std::filesystem::path& file);

}  // namespace palpa::calibrate
