#pragma once

#include "anatomy/geometry/csv_field.h"

namespace palpa::report {

using palpa::csvField;

}  // namespace palpa::report
