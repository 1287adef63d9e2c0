#pragma once

#include <string>

#include "apps/station/json_file.h"

namespace palpa::station {

/// Where a task stands among visual and haptic augmented realities, in words (Jeon, Choi & Harders
/// 2015, their section 2): its file's "taxonomy".
struct Taxonomy {
  std::string visual, haptic;  ///< how much of what is seen, of what is felt, is real
  std::string purpose;         ///< artificial recreation, or augmented perception
  std::string property;        ///< within a property or between properties
};

/// Throws UsageError naming a field that is missing.
Taxonomy taxonomyOf(const JsonFile& task);

}  // namespace palpa::station
