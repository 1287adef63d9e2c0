#pragma once

#include <memory>
#include <optional>

#include "ar/headset/xr_call.h"

namespace palpa::ar {

/// From now on no library of this process is unloaded, not even at its end: a thread that never
/// comes back runs in one of them, and would run on where no code is any more.
void keepLibrariesLoaded();

/// Waits for the runtime's next frame on a thread of its own, since xrWaitFrame has no end where a
/// compositor hangs: keys and the emergency stop must be heard meanwhile. (It may be called from
/// any thread; of OpenGL it needs nothing.)
class XrFrameWait {
 public:
  explicit XrFrameWait(XrSession session);
  ~XrFrameWait();  ///< a thread that never comes back is left behind
  /// The next frame's timing, or nothing after a tenth of a second; then it is still waited for.
  /// Throws XrFailure.
  std::optional<XrFrameState> next();
  /// Whether the runtime has answered, or does within a second.
  bool settled();
  /// A frame that was waited for and is not wanted any more: its session ends, and the next one
  /// starts with a frame of its own.
  void forget();

 private:
  struct Shared;
  std::shared_ptr<Shared> shared_;
};

}  // namespace palpa::ar
