#pragma once

#include "apps/assess/metrics/motion.h"

namespace palpa::metrics {

/// What the tool did inside. All 0 where it was never inserted.
double tissueTime(const Motion& motion);  ///< s with any of the shaft inside
double tissuePath(const Motion& motion);  ///< m of the tip's path while inserted in both of two
                                          ///< neighbouring steps

/// m^2 that the inserted part of the shaft sweeps over: for each step the quadrilateral from
/// (entry, tip) before to (entry, tip) after, as two triangles. A needle that goes straight in
/// sweeps nothing; one that fans about does. After Perk Tutor's tissue damage.
double tissueDamage(const Motion& motion);

/// Times the tool went in, from outside.
int insertions(const Motion& motion);

}  // namespace palpa::metrics
