#pragma once

#include <nlohmann/json_fwd.hpp>

#include "apps/assess/needle/needle_views.h"
#include "apps/evidence/recorded_session.h"

namespace palpa::evidence {

/// Where the needle was in a trial, for pictures that move: {"views": [...], "t_s": [...]} with, of
/// each view, what it cuts, what is taught there and, at each of these times, in mm, the needle's
/// tip (from in front), tip and shaft (in section), aim (at the vein); null where it cannot be
/// seen there.
nlohmann::json needleTrack(const assess::NeedleViews& views, const NeedleSamples& samples);

}  // namespace palpa::evidence
