#pragma once

#include "anatomy/base/json_file.h"
#include "anatomy/parametric/body_part.h"
#include "anatomy/patient.h"
#include "apps/assess/palpation/search_area.h"

/// Where a palpation takes place, as its task's file says it: the phantom's size and the shape of
/// its top, and the part of that which is searched.
namespace palpa::task_palpation {

/// "phantom": m, across, away from the trainee, high. Throws UsageError naming the field.
Vec3 sizeOf(const JsonFile& task);

/// "phantom/shape" (`TopShape`), its origin on it; none: flat.
///     {"arch_high_mm": 25, "arch_half_across_mm": 50, "arch_half_away_mm": 45, "arch_foot_mm": 12,
///      "taper_per_m": 0, "hollow_per_m": 0,
///      "mounds": [{"name": "left lobe", "across_mm": 16, "away_mm": 0, "high_mm": 2,
///                  "wide_across_mm": 8, "wide_away_mm": 16, "turned_deg": 10}]}
/// All but what is used may be left out; an arch without a half length, a mound without a width has
/// no end that way. Throws UsageError naming the field.
TopShape topOf(const JsonFile& task);

/// "area": half the sides of a rectangle, and in it an outline, "outline_mm": [[x, y], ...]; with
/// the top it lies on. Throws UsageError naming the field.
assess::SearchArea areaOf(const JsonFile& task);

/// "phantom/seen_as": the part of a body that the block stands for; none: the block itself. Throws
/// UsageError naming the field.
std::optional<anatomy::BodyPart> seenAs(const JsonFile& task);

/// The phantom as it is shown: a block, and in the large view that part.
anatomy::Patient shownPhantom(const Vec3& size, const std::string& title,
                              const assess::SearchArea& area,
                              const std::optional<anatomy::BodyPart>& seen_as);

/// That a tip of this radius, m, is led by the shape: it never meets two places at once, and no
/// place that is searched is steeper than a hand presses along its normal. Throws UsageError.
void requireTouchable(const JsonFile& task, const assess::SearchArea& area, double tip_radius);

/// Least height of the phantom over its base where it is searched, m.
double leastHeight(const Vec3& size, const assess::SearchArea& area);

}  // namespace palpa::task_palpation
