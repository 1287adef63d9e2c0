#include "ar/headset/xr_controls.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "ar/headset/xr_call.h"

namespace palpa::ar {
namespace {

constexpr const char* kHands[] = {"/user/hand/left", "/user/hand/right"};

/// Where a kind of controller has what we use; null: nowhere.
struct Profile {
  const char *name, *trigger, *recentre, *start;
};
constexpr Profile kProfiles[] = {
    {"/interaction_profiles/khr/simple_controller", "/input/select/click", "/input/menu/click",
     nullptr},
    {"/interaction_profiles/htc/vive_controller", "/input/trigger/value", "/input/menu/click",
     "/input/squeeze/click"},
    {"/interaction_profiles/microsoft/motion_controller", "/input/trigger/value",
     "/input/menu/click", "/input/squeeze/click"},
    {"/interaction_profiles/valve/index_controller", "/input/trigger/value", "/input/b/click",
     "/input/a/click"},
    {"/interaction_profiles/oculus/touch_controller", "/input/trigger/value",
     "/input/thumbstick/click", "/input/squeeze/value"}};

XrPath pathOf(XrInstance instance, const std::string& text) {
  XrPath path = XR_NULL_PATH;
  xrCheck(xrStringToPath(instance, text.c_str(), &path), "xrStringToPath");
  return path;
}

/// Went down since the last sync.
bool pressed(XrSession session, XrAction button, XrPath hand) {
  const XrActionStateGetInfo of{XR_TYPE_ACTION_STATE_GET_INFO, nullptr, button, hand};
  XrActionStateBoolean state{
      XR_TYPE_ACTION_STATE_BOOLEAN, nullptr, XR_FALSE, XR_FALSE, 0, XR_FALSE};
  xrCheck(xrGetActionStateBoolean(session, &of, &state), "xrGetActionStateBoolean");
  return state.isActive && state.changedSinceLastSync && state.currentState;
}

}  // namespace

XrControls::XrControls(XrInstance instance, XrSession session) {
  for (std::size_t i = 0; i < 2; ++i) hands_[i] = pathOf(instance, kHands[i]);
  XrActionSetCreateInfo info{XR_TYPE_ACTION_SET_CREATE_INFO, nullptr, {}, {}, 0};
  std::strcpy(info.actionSetName, "palpa");
  std::strcpy(info.localizedActionSetName, "Palpa");
  XrActionSet set = XR_NULL_HANDLE;
  xrCheck(xrCreateActionSet(instance, &info, &set), "xrCreateActionSet");
  set_ = XrOwnedActionSet(set);
  pose_ = makeAction("tool", "Needle or probe", XR_ACTION_TYPE_POSE_INPUT);
  trigger_ = makeAction("plunger", "Plunger", XR_ACTION_TYPE_FLOAT_INPUT);
  recentre_ = makeAction("recentre", "Patient in front of me", XR_ACTION_TYPE_BOOLEAN_INPUT);
  start_ = makeAction("start", "Start", XR_ACTION_TYPE_BOOLEAN_INPUT);
  vibration_ = makeAction("felt", "What is felt", XR_ACTION_TYPE_VIBRATION_OUTPUT);
  suggest(instance);
  for (std::size_t i = 0; i < 2; ++i) {
    const XrActionSpaceCreateInfo of_hand{XR_TYPE_ACTION_SPACE_CREATE_INFO, nullptr, pose_,
                                          hands_[i], identityXr()};
    XrSpace space = XR_NULL_HANDLE;
    xrCheck(xrCreateActionSpace(session, &of_hand, &space), "xrCreateActionSpace");
    spaces_[i] = XrOwnedSpace(space);
  }
  const XrSessionActionSetsAttachInfo attach{XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO, nullptr, 1,
                                             &set};
  xrCheck(xrAttachSessionActionSets(session, &attach), "xrAttachSessionActionSets");
}

XrAction XrControls::makeAction(const char* name, const char* label, XrActionType type) {
  XrActionCreateInfo info{XR_TYPE_ACTION_CREATE_INFO, nullptr, {}, type, 2, hands_.data(), {}};
  std::strncpy(info.actionName, name, XR_MAX_ACTION_NAME_SIZE - 1);
  std::strncpy(info.localizedActionName, label, XR_MAX_LOCALIZED_ACTION_NAME_SIZE - 1);
  XrAction action = XR_NULL_HANDLE;
  xrCheck(xrCreateAction(set_.get(), &info, &action), "xrCreateAction");
  return action;
}

/// A runtime that does not know a kind of controller says so: no harm.
void XrControls::suggest(XrInstance instance) const {
  for (const Profile& profile : kProfiles) {
    std::vector<XrActionSuggestedBinding> bindings;
    for (const char* hand : kHands) {
      const auto add = [&](XrAction action, const char* where) {
        bindings.push_back({action, pathOf(instance, std::string(hand) + where)});
      };
      add(pose_, "/input/aim/pose");
      add(trigger_, profile.trigger);
      add(recentre_, profile.recentre);
      if (profile.start) add(start_, profile.start);
      add(vibration_, "/output/haptic");
    }
    const XrInteractionProfileSuggestedBinding suggestion{
        XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING, nullptr, pathOf(instance, profile.name),
        static_cast<std::uint32_t>(bindings.size()), bindings.data()};
    const XrResult result = xrSuggestInteractionProfileBindings(instance, &suggestion);
    if (result != XR_ERROR_PATH_UNSUPPORTED) xrCheck(result, "xrSuggestInteractionProfileBindings");
  }
}

ButtonPresses XrControls::read(XrSession session, XrSpace base, XrTime time,
                               std::array<HandInput, 2>* hands) {
  const XrActiveActionSet active{set_.get(), XR_NULL_PATH};
  const XrActionsSyncInfo sync{XR_TYPE_ACTIONS_SYNC_INFO, nullptr, 1, &active};
  for (HandInput& hand : *hands) hand.tracked = false;
  ButtonPresses asked;
  if (xrCheck(xrSyncActions(session, &sync), "xrSyncActions") == XR_SESSION_NOT_FOCUSED)
    return asked;
  for (std::size_t i = 0; i < 2; ++i) {
    const XrActionStateGetInfo drawing{XR_TYPE_ACTION_STATE_GET_INFO, nullptr, trigger_, hands_[i]};
    XrActionStateFloat drawn{XR_TYPE_ACTION_STATE_FLOAT, nullptr, 0, XR_FALSE, 0, XR_FALSE};
    xrCheck(xrGetActionStateFloat(session, &drawing, &drawn), "xrGetActionStateFloat");
    if (drawn.isActive && std::isfinite(drawn.currentState))
      (*hands)[i].trigger = std::clamp(static_cast<double>(drawn.currentState), 0.0, 1.0);
    asked.recentre |= pressed(session, recentre_, hands_[i]);
    asked.start |= pressed(session, start_, hands_[i]);
    locate(session, base, time, i, &(*hands)[i]);
  }
  return asked;
}

void XrControls::locate(XrSession session, XrSpace base, XrTime time, std::size_t i,
                        HandInput* hand) const {
  const XrActionStateGetInfo holding{XR_TYPE_ACTION_STATE_GET_INFO, nullptr, pose_, hands_[i]};
  XrActionStatePose held{XR_TYPE_ACTION_STATE_POSE, nullptr, XR_FALSE};
  xrCheck(xrGetActionStatePose(session, &holding, &held), "xrGetActionStatePose");
  if (!held.isActive) return;
  XrSpaceLocation where{XR_TYPE_SPACE_LOCATION, nullptr, 0, identityXr()};
  xrCheck(xrLocateSpace(spaces_[i].get(), base, time, &where), "xrLocateSpace");
  // Not only valid: a place that is inferred while the gyroscopes turn on would swing the tip.
  constexpr XrSpaceLocationFlags kKnown =
      XR_SPACE_LOCATION_POSITION_VALID_BIT | XR_SPACE_LOCATION_ORIENTATION_VALID_BIT |
      XR_SPACE_LOCATION_POSITION_TRACKED_BIT | XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT;
  hand->tracked = (where.locationFlags & kKnown) == kKnown;
  if (hand->tracked) hand->X_LG = poseFromXr(where.pose);
}

void XrControls::vibrate(XrSession session, std::size_t hand, double seconds, double strength) {
  const XrHapticVibration pulse{
      XR_TYPE_HAPTIC_VIBRATION, nullptr, std::max<XrDuration>(std::llround(1e9 * seconds), 1),
      XR_FREQUENCY_UNSPECIFIED, static_cast<float>(std::clamp(strength, 0.0, 1.0))};
  const XrHapticActionInfo where{XR_TYPE_HAPTIC_ACTION_INFO, nullptr, vibration_, hands_.at(hand)};
  xrCheck(
      xrApplyHapticFeedback(session, &where, reinterpret_cast<const XrHapticBaseHeader*>(&pulse)),
      "xrApplyHapticFeedback");
}

}  // namespace palpa::ar
