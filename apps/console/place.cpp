#include "apps/console/place.h"

#include <string_view>
#include <utility>

#include "apps/console/web/guard.h"
#include "apps/runtime/clock.h"

namespace palpa::console {

std::string newId() { return runtime::dateText("%Y%m%d-%H%M%S-") + randomKey().substr(0, 8); }

bool isShown(const std::string& name) {
  if (name == "report.html" || name == "trials.csv") return true;
  for (const auto& [stem, ending] :
       {std::pair<std::string_view, std::string_view>{"exam-", ".html"}, {"certificate-", ".pdf"}})
    if (name.size() > stem.size() + ending.size() && name.starts_with(stem) &&
        name.ends_with(ending))
      return isId(name.substr(0, name.size() - ending.size()));
  return name.size() > 9 && name.rfind("view-", 0) == 0 &&
         name.compare(name.size() - 4, 4, ".png") == 0 && isId(name.substr(0, name.size() - 4));
}

}  // namespace palpa::console
