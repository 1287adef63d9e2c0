#pragma once

#include <vector>

#include "apps/calibrate/collect.h"
#include "apps/calibrate/results.h"
#include "apps/station/object_map_file.h"
#include "calibration/touch/object_map.h"
#include "calibration/touch/relaxing_press.h"

/// An object's stiffness and friction all over its top, learnt by touching it here and there.
namespace palpa::calibrate {

inline constexpr double kLearntDepth = 3e-3;  ///< m, of the secant stiffness

/// Each one press, held, and a slide, at one place.
struct ObjectTouches {
  std::vector<FeltSamples> touches;
  double seconds = 0;  ///< from the first request to the end of the last touch
};

struct LearntObject {
  calibration::PressedThing pressed;
  calibration::ObjectMap stiffness;  ///< N/m, secant at kLearntDepth, pressed slowly
  /// What rubs, less what only speed makes, by what presses while it slides
  calibration::ObjectMap friction;
  double viscous = 0;          ///< N s/m, the same all over
  int used = 0, left_out = 0;  ///< touches
};

/// Throws Error for touches that tell too little.
LearntObject learnObject(const std::vector<FeltSamples>& touches);

/// As sessions take it up; no date.
station::MappedObject mappedObjectOf(const LearntObject& object,
                                     const calibration::MappedArea& area);

/// The top of a block of 100 x 100 mm, within 10 % on nine tenths of it.
calibration::MappedArea objectArea();

/// Touches for `seconds` at most, or until the stiffness is known as well as `area` asks: first in
/// rows, then where the map knows least. `sample` as in a Request. Throws Error, and UsageError for
/// a station without force sensor or sample.
ObjectTouches collectObject(const Scene& scene, const std::string& sample,
                            const calibration::MappedArea& area, double seconds = 180);

/// One recording of many touches, parted where nothing is touched.
ObjectTouches touchesIn(const FeltSamples& felt);

Result objectResult(const ObjectTouches& samples, const calibration::MappedArea& area,
                    const Origin& origin);

}  // namespace palpa::calibrate
