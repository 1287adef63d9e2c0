#include "apps/station/assets.h"

#include <cstdlib>
#include <vector>

#include "anatomy/base/error.h"

namespace palpa::station {
namespace {

namespace fs = std::filesystem;

bool areAssets(const fs::path& folder) {
  std::error_code none;
  return fs::is_directory(folder / "materials", none);
}

}  // namespace

fs::path programFile() {
  std::error_code none;
  return fs::read_symlink("/proc/self/exe", none);
}

fs::path assetsFolder(const fs::path& program) {
  const char* given = std::getenv("PALPA_ASSETS");
  if (given && *given) {
    if (areAssets(given)) return given;
    throw Error("is not the program's data folder (there is no materials/ in it)",
                std::string("PALPA_ASSETS=") + given,
                "Correct PALPA_ASSETS, or unset it: then the program looks where it was installed");
  }
  const fs::path beside = program.parent_path().parent_path() / "share/palpa/assets";
  for (const fs::path& candidate :
       {beside, fs::path(PALPA_SOURCE_ASSETS), fs::path(PALPA_INSTALL_ASSETS)})
    if (areAssets(candidate)) return candidate;
  throw Error("the program's data folder is missing", beside.string(),
              "Install palpa again, or set PALPA_ASSETS to the assets folder of this version");
}

fs::path assetsFolder() { return assetsFolder(programFile()); }

fs::path assetFile(const std::string& relative) { return assetsFolder() / relative; }

}  // namespace palpa::station
