#include "apps/trial/shown.h"

#include <algorithm>

namespace palpa::trial {

using presentation::Presentation;
using presentation::SkinLook;
using scene::SkinStyle;

void keepShown(const Presentation& shown, scene::SceneState* state) {
  if (!shown.arrows) state->forces.clear();
  if (!shown.trail) state->trail_A.clear();
  if (!shown.anatomy) {  // an ellipse over solid skin would show where the hidden tip is
    state->lumps.clear();
    state->tip_covariance_A.reset();
  }
  if (shown.skin != SkinLook::free) state->skin = firstSkin(shown);
  if (!shown.skin_deflection) state->skin_push.reset();
  if (!shown.newtons) state->hud.force.clear();
  if (!shown.tissue_words) state->hud.depth.clear();
  if (!shown.contact_words) state->hud.touched.clear();
  if (shown.guidance) return;
  state->guide.reset();
  state->lead_A.reset();
  if (state->coverage)
    std::fill(state->coverage->levels.begin(), state->coverage->levels.end(), std::uint8_t{0});
}

SkinStyle firstSkin(const Presentation& shown) {
  return shown.skin == SkinLook::solid ? SkinStyle::solid : SkinStyle::translucent;
}

SkinStyle nextSkin(const Presentation& shown, SkinStyle now) {
  if (shown.skin != SkinLook::free) return now;
  return now == SkinStyle::translucent ? SkinStyle::solid
         : now == SkinStyle::solid     ? SkinStyle::hidden
                                       : SkinStyle::translucent;
}

}  // namespace palpa::trial
