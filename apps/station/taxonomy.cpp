#include "apps/station/taxonomy.h"

namespace palpa::station {

Taxonomy taxonomyOf(const JsonFile& task) {
  return {task.text("taxonomy/visual"), task.text("taxonomy/haptic"), task.text("taxonomy/purpose"),
          task.text("taxonomy/property")};
}

}  // namespace palpa::station
