#pragma once

#include <filesystem>

#include "haptics/materials/needle_materials.h"

namespace palpa::station {

/// What the needle feels, with the spread of the skin's strength over trials.
struct NeedleFile {
  haptics::NeedleMaterials materials;
  double puncture_low_N = 1.0, puncture_high_N = 2.5;  ///< uniform between the two, per trial
};

/// assets/materials/needle.json: every figure with unit, source and range. Throws UsageError.
NeedleFile readNeedleFile(const std::filesystem::path& file);

}  // namespace palpa::station
