#include "apps/station/assets.h"

#include <cstdlib>

#include "anatomy/geometry/error.h"

namespace palpa::station {

std::filesystem::path assetsFolder() {
  const char* given = std::getenv("PALPA_ASSETS");
  for (const char* candidate : {given, PALPA_SOURCE_ASSETS, PALPA_INSTALL_ASSETS})
    if (candidate && std::filesystem::is_directory(std::filesystem::path(candidate) / "materials"))
      return candidate;
  throw Error("the program's data folder is missing", given ? given : PALPA_SOURCE_ASSETS,
              "Set PALPA_ASSETS to the assets folder of this version");
}

std::filesystem::path assetFile(const std::string& relative) { return assetsFolder() / relative; }

}  // namespace palpa::station
