#include "ar/headset/keep_loaded.h"

#include <dlfcn.h>
#include <link.h>

#include <string>
#include <vector>

namespace palpa::ar {

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

}  // namespace palpa::ar
