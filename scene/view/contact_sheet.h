#pragma once

#include "anatomy/patient.h"
#include "scene/scene_state.h"
#include "scene/window/gl_context.h"

namespace palpa::scene {

/// A patient on one page: solid, translucent, and bones and vessels alone (rows), each from the
/// front, the side and above (columns), parallel, with a scale bar. The upper rows show the whole
/// patient in one scale, the third what is left without skin and muscle, as large as it fits. RGB,
/// top row first. Throws Error for a page smaller than 300 x 300 or larger than 8192 x 8192 pixels.
Image contactSheet(GlContextProvider& context, const anatomy::Patient& patient, int width,
                   int height);

}  // namespace palpa::scene
