#pragma once

#include <filesystem>
#include <string>

namespace palpa::station {

/// Where the program's data lie: PALPA_ASSETS where it is set; else beside the program (its
/// folder's ../share/palpa/assets), so that an installed tree may be moved; else the source tree it
/// was built from, else where it was installed. Throws Error when they are not there.
std::filesystem::path assetsFolder();
/// The same for a program that lies elsewhere.
std::filesystem::path assetsFolder(const std::filesystem::path& program);

/// The running program's own file; empty where the system does not tell.
std::filesystem::path programFile();

/// A file under it, e.g. assetFile("materials/needle.json").
std::filesystem::path assetFile(const std::string& relative);

}  // namespace palpa::station
