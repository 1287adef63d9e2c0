#include "anatomy/base/left_behind.h"

#include <dlfcn.h>
#include <link.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

namespace palpa {
namespace {

void keepLibrariesLoaded() {
  std::vector<std::string> names;
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* to) {
        if (info->dlpi_name && *info->dlpi_name)
          static_cast<std::vector<std::string>*>(to)->emplace_back(info->dlpi_name);
        return 0;
      },
      &names);
  for (const std::string& name : names)
    dlopen(name.c_str(),
           RTLD_LAZY | RTLD_NOLOAD |
               RTLD_NODELETE);  // the handle is never given back, which is what keeps it
}

/// What was registered after it has run by now; what was before, the libraries' ends among it, does
/// not.
void endAtOnce(int exit_code, void*) {
  std::fflush(nullptr);
  std::_Exit(exit_code);
}

}  // namespace

void leaveBehind(std::shared_ptr<void> all) {
  static std::vector<std::shared_ptr<void>>& kept = *new std::vector<std::shared_ptr<void>>;
  kept.push_back(std::move(all));
  keepLibrariesLoaded();
  [[maybe_unused]] static const int once = on_exit(&endAtOnce, nullptr);
}

}  // namespace palpa
