#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "tests/openxr_runtime/world.h"

namespace palpa::test_xr {
namespace {

constexpr float kTurn = 6.2831853f;
constexpr const char* kRight = "/user/hand/right";

XRAPI_ATTR XrResult XRAPI_CALL StringToPath(XrInstance, const char* text, XrPath* path) {
  World& w = world();
  const auto [entry, fresh] = w.paths.emplace(text, w.paths.size() + 1);
  if (fresh) w.names[entry->second] = text;
  *path = entry->second;
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL PathToString(XrInstance, XrPath path, std::uint32_t capacity,
                                            std::uint32_t* count, char* out) {
  const std::string& name = world().nameOf(path);
  *count = static_cast<std::uint32_t>(name.size() + 1);
  if (capacity >= *count) std::memcpy(out, name.c_str(), *count);
  return capacity == 0 || capacity >= *count ? XR_SUCCESS : XR_ERROR_SIZE_INSUFFICIENT;
}

XRAPI_ATTR XrResult XRAPI_CALL CreateActionSet(XrInstance, const XrActionSetCreateInfo*,
                                               XrActionSet* set) {
  *set = world().ledger.opened<XrActionSet>("action set");
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL DestroyActionSet(XrActionSet set) {
  World& w = world();
  w.ledger.closed(set);
  w.ledger.closeAll("action");
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL CreateAction(XrActionSet, const XrActionCreateInfo* info,
                                            XrAction* action) {
  World& w = world();
  *action = w.ledger.opened<XrAction>("action");
  w.actions[*action] = {info->actionName, info->actionType};
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL DestroyAction(XrAction action) {
  world().ledger.closed(action);
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL SuggestInteractionProfileBindings(
    XrInstance, const XrInteractionProfileSuggestedBinding* suggestion) {
  World& w = world();
  const std::string profile = w.nameOf(suggestion->interactionProfile);
  if (profile == "/interaction_profiles/valve/index_controller")
    return XR_ERROR_PATH_UNSUPPORTED;  // not all runtimes know all
  for (std::uint32_t i = 0; i < suggestion->countSuggestedBindings; ++i)
    w.bindings[profile].emplace_back(suggestion->suggestedBindings[i].action,
                                     w.nameOf(suggestion->suggestedBindings[i].binding));
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL AttachSessionActionSets(XrSession,
                                                       const XrSessionActionSetsAttachInfo*) {
  World& w = world();
  w.ledger.called("xrAttachSessionActionSets");
  return w.ledger.calls("xrAttachSessionActionSets") > 1 ? XR_ERROR_ACTIONSETS_ALREADY_ATTACHED
                                                         : XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL GetCurrentInteractionProfile(XrSession, XrPath,
                                                            XrInteractionProfileState* state) {
  return StringToPath(world().instance, world().plan.controller.c_str(),
                      &state->interactionProfile);
}

XRAPI_ATTR XrResult XRAPI_CALL SyncActions(XrSession, const XrActionsSyncInfo*) {
  World& w = world();
  w.ledger.called("xrSyncActions");
  if (w.lost) return XR_ERROR_SESSION_LOST;
  return w.faultNow("not_focused") ? XR_SESSION_NOT_FOCUSED : XR_SUCCESS;
}

bool ofRightHand(const XrActionStateGetInfo* info) {
  return world().nameOf(info->subactionPath) == kRight && boundNow(info->action);
}

XRAPI_ATTR XrResult XRAPI_CALL GetActionStatePose(XrSession, const XrActionStateGetInfo* info,
                                                  XrActionStatePose* state) {
  state->isActive = ofRightHand(info) && !world().faultNow("controller_off");
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL GetActionStateFloat(XrSession, const XrActionStateGetInfo* info,
                                                   XrActionStateFloat* state) {
  const World& w = world();
  *state = {XR_TYPE_ACTION_STATE_FLOAT, nullptr, 0, XR_FALSE, w.now, XR_FALSE};
  if (!ofRightHand(info)) return XR_SUCCESS;
  state->isActive = XR_TRUE;
  state->currentState = triggerAt(w.frame);
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL GetActionStateBoolean(XrSession, const XrActionStateGetInfo* info,
                                                     XrActionStateBoolean* state) {
  World& w = world();
  *state = {XR_TYPE_ACTION_STATE_BOOLEAN, nullptr, XR_FALSE, XR_FALSE, w.now, XR_FALSE};
  if (!ofRightHand(info)) return XR_SUCCESS;
  state->isActive = XR_TRUE;
  const bool down = w.plan.fault == "menu_pressed" && w.actions[info->action].first == "recentre" &&
                    w.frame == w.plan.fault_frame;
  const bool started = w.plan.fault == "start_pressed" &&
                       w.actions[info->action].first == "start" && w.frame == w.plan.fault_frame;
  state->currentState = state->changedSinceLastSync = down || started;
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL CreateActionSpace(XrSession, const XrActionSpaceCreateInfo* info,
                                                 XrSpace* space) {
  World& w = world();
  *space = w.ledger.opened<XrSpace>("space");
  w.spaces[*space] = w.nameOf(info->subactionPath) == kRight ? 3 : 2;
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL EnumerateReferenceSpaces(XrSession, std::uint32_t capacity,
                                                        std::uint32_t* count,
                                                        XrReferenceSpaceType* out) {
  return give(std::vector{XR_REFERENCE_SPACE_TYPE_VIEW, XR_REFERENCE_SPACE_TYPE_LOCAL}, capacity,
              count, out);
}

XRAPI_ATTR XrResult XRAPI_CALL CreateReferenceSpace(XrSession,
                                                    const XrReferenceSpaceCreateInfo* info,
                                                    XrSpace* space) {
  World& w = world();
  if (info->referenceSpaceType > XR_REFERENCE_SPACE_TYPE_LOCAL)
    return XR_ERROR_REFERENCE_SPACE_UNSUPPORTED;
  *space = w.ledger.opened<XrSpace>("space");
  w.spaces[*space] = info->referenceSpaceType == XR_REFERENCE_SPACE_TYPE_LOCAL ? 0 : 1;
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL DestroySpace(XrSpace space) {
  world().ledger.closed(space);
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL LocateSpace(XrSpace space, XrSpace, XrTime, XrSpaceLocation* where) {
  World& w = world();
  where->locationFlags = 0;
  if (w.spaces[space] != 3) return XR_SUCCESS;
  where->locationFlags = XR_SPACE_LOCATION_ORIENTATION_VALID_BIT |
                         XR_SPACE_LOCATION_POSITION_VALID_BIT |
                         XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT;
  if (!w.faultNow("inferred")) where->locationFlags |= XR_SPACE_LOCATION_POSITION_TRACKED_BIT;
  where->pose = handAt(w.frame);
  char line[160];
  std::snprintf(line, sizeof line, "hand %d %.6f %.6f %.6f %.6f", w.frame, where->pose.position.x,
                where->pose.position.y, where->pose.position.z, triggerAt(w.frame));
  w.ledger.note(line);
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL ApplyHapticFeedback(XrSession, const XrHapticActionInfo* info,
                                                   const XrHapticBaseHeader*) {
  World& w = world();
  w.ledger.called("xrApplyHapticFeedback");
  if (w.actions[info->action].second != XR_ACTION_TYPE_VIBRATION_OUTPUT)
    w.ledger.complain("vibration of what does not vibrate");
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL StopHapticFeedback(XrSession, const XrHapticActionInfo*) {
  return XR_SUCCESS;
}

}  // namespace

/// A circle of 40 mm about a point under the eyes in 4 s, pointing down and ahead; until the plan
/// lets it stand.
XrPosef handAt(int frame) {
  const float round = kTurn * static_cast<float>(std::min(frame, world().plan.stands)) / 360;
  const float half = 0.5f * -1.1f;  // about x
  return {{std::sin(half), 0, 0, std::cos(half)},
          {0.1f + 0.04f * std::cos(round), -0.25f + 0.01f * std::sin(2 * round),
           -0.30f + 0.04f * std::sin(round)}};
}

float triggerAt(int frame) { return std::clamp(static_cast<float>(frame) / 400, 0.0f, 1.0f); }

bool boundNow(XrAction action) {
  World& w = world();
  const auto& of_controller = w.bindings[w.plan.controller];
  return std::any_of(of_controller.begin(), of_controller.end(), [&](const auto& binding) {
    return binding.first == action && binding.second.rfind(kRight, 0) == 0;
  });
}

void addInputFunctions(std::map<std::string, PFN_xrVoidFunction>* all) {
  PALPA_XR(StringToPath);
  PALPA_XR(PathToString);
  PALPA_XR(CreateActionSet);
  PALPA_XR(DestroyActionSet);
  PALPA_XR(CreateAction);
  PALPA_XR(DestroyAction);
  PALPA_XR(SuggestInteractionProfileBindings);
  PALPA_XR(AttachSessionActionSets);
  PALPA_XR(GetCurrentInteractionProfile);
  PALPA_XR(SyncActions);
  PALPA_XR(GetActionStatePose);
  PALPA_XR(GetActionStateFloat);
  PALPA_XR(GetActionStateBoolean);
  PALPA_XR(CreateActionSpace);
  PALPA_XR(EnumerateReferenceSpaces);
  PALPA_XR(CreateReferenceSpace);
  PALPA_XR(DestroySpace);
  PALPA_XR(LocateSpace);
  PALPA_XR(ApplyHapticFeedback);
  PALPA_XR(StopHapticFeedback);
}

}  // namespace palpa::test_xr
