#pragma once

#include <array>

#include "ar/headset/headset.h"
#include "ar/headset/xr_call.h"

namespace palpa::ar {

/// What was asked for with a button since the last time.
struct ButtonPresses {
  bool recentre = false, start = false;
};

/// The controllers in both hands: where they point, the trigger, the buttons that recentre and
/// start, vibration. Actions and bindings by the profiles of the OpenXR 1.0 specification,
/// section 6.4; a runtime binds what it has.
class XrControls {
 public:
  XrControls(XrInstance instance, XrSession session);

  /// Reads all at a time of the runtime's. `base`: the space that poses are in.
  ButtonPresses read(XrSession session, XrSpace base, XrTime time, std::array<HandInput, 2>* hands);
  void vibrate(XrSession session, std::size_t hand, double seconds, double strength);

 private:
  XrAction makeAction(const char* name, const char* label, XrActionType type);
  void suggest(XrInstance instance) const;
  void locate(XrSession session, XrSpace base, XrTime time, std::size_t i, HandInput* hand) const;

  XrOwnedActionSet set_;
  std::array<XrPath, 2> hands_{};
  XrAction pose_ = XR_NULL_HANDLE, trigger_ = XR_NULL_HANDLE, recentre_ = XR_NULL_HANDLE,
           start_ = XR_NULL_HANDLE, vibration_ = XR_NULL_HANDLE;  // go with their set
  std::array<XrOwnedSpace, 2> spaces_;
};

}  // namespace palpa::ar
