#pragma once

#include <filesystem>
#include <string>

namespace palpa::station {

/// Where the program's data lie: PALPA_ASSETS, else the source tree it was built from, else where it was
/// installed. Throws Error when none of them is there.
std::filesystem::path assetsFolder();

/// A file under it, e.g. assetFile("materials/needle.json").
std::filesystem::path assetFile(const std::string& relative);

}  // namespace palpa::station
