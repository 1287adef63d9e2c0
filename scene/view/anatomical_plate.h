#pragma once

#include <optional>

#include "anatomy/patient.h"
#include "scene/scene_state.h"
#include "scene/view/framing.h"
#include "scene/window/gl_context.h"

namespace palpa::scene {

struct PlateWish {
  Plane plane = Plane::frontal;
  /// m along the line of sight behind the entry point (without one, behind the middle): the patient
  /// is cut there, and what is nearer is taken away
  std::optional<double> section;
  SkinStyle skin = SkinStyle::hidden;
  int width = 1600, height = 1200;
};

/// A patient as on a printed plate: parallel, on white, each kind of organ named by a line to where
/// most of it is seen, the letters of the sides, and a scale bar. RGB, top row first. Throws
/// UsageError for a picture smaller than 400 x 300 or larger than 4096 x 4096 pixels.
Image anatomicalPlate(GlContextProvider& context, const anatomy::Patient& patient,
                      const PlateWish& wish);

}  // namespace palpa::scene
