#pragma once

#include <vector>

#include "apps/report/html.h"
#include "apps/report/session_report.h"

namespace palpa::report {

/// The pictures with caption and moment, embedded. One that cannot be read (or is no PNG) is named
/// in its place: a lost picture must not cost the report.
void writePictures(Html& html, const std::vector<Picture>& pictures);

}  // namespace palpa::report
