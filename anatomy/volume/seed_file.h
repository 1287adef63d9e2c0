#pragma once

#include <filesystem>

#include "anatomy/volume/scan.h"

namespace palpa::anatomy {

/// JSON: {"format": "palpa-seeds", "unit": "mm", "points": {"vein_svc": [x, y, z], ...}} in the
/// volume's frame S. Names other than those that the search knows are refused. Throws Error.
Seeds readSeeds(const std::filesystem::path& file);
void writeSeeds(const Seeds& seeds, const std::filesystem::path& file);  ///< beside, then renamed

/// "name=x,y,z" in millimetres. Throws UsageError.
void addSeed(const std::string& text, Seeds* seeds);

/// "--seed-point name=x,y,z" that gives the point again.
std::string seedOption(const std::string& name, const Vec3& p_S);

}  // namespace palpa::anatomy
