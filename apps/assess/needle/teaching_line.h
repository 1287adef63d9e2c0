#pragma once

#include "anatomy/patient.h"
#include "anatomy/query/surface_query.h"
#include "calibration/teaching_line.h"

namespace palpa::assess {

/// The patient's own teaching line: from the entry point, along the skin's normal there, to the
/// vein's target, as its landmarks and its skin say. Throws Error where one of them is missing.
calibration::TeachingLine teachingLineOf(const anatomy::Patient& patient,
                                         const anatomy::SurfaceQuery& query);

}  // namespace palpa::assess
