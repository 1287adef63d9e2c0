#pragma once

#include <array>
#include <string>

#include "anatomy/geometry/local_geometry.h"
#include "apps/station/json_file.h"

namespace palpa::task_needle {

/// What tissues and surfaces are called where the thing that is punctured is no patient:
///   "words": {"tissues": {"fat": "cancellous bone"}, "organs": {"skin": "bone"}}
/// Those not named keep their names.
struct TaskWords {
  std::array<std::string, kTissueCount> tissue;  ///< empty: its own name
  std::array<std::string, kOrganCount> organ;
  std::string of(Tissue t) const;
  std::string of(Organ o) const;
};

/// Throws UsageError for tissues and organs that there are not.
TaskWords wordsIn(const station::JsonFile& task);

}  // namespace palpa::task_needle
