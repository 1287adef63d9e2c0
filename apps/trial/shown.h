#pragma once

#include "apps/presentation/presentation.h"
#include "scene/scene_state.h"

namespace palpa::trial {

/// Takes away what the presentation does not show, whatever the task has put together: forces,
/// trail, lines and rings that lead, the map of what was felt, lumps and the tip's ellipse seen
/// through the skin, and the words for each; gives the skin its look. What there would be without a
/// simulator stays: tool, blood, time, trial, marks that were made, notices.
void keepShown(const presentation::Presentation& shown, scene::SceneState* state);

/// The skin as it is shown at first, and after the trainee's key: that changes only a free one.
scene::SkinStyle firstSkin(const presentation::Presentation& shown);
scene::SkinStyle nextSkin(const presentation::Presentation& shown, scene::SkinStyle now);

}  // namespace palpa::trial
