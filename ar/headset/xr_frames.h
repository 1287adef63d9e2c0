#pragma once

#include <array>
#include <optional>
#include <string>

#include "ar/headset/headset.h"
#include "ar/headset/xr_controls.h"
#include "ar/headset/xr_eye.h"
#include "ar/headset/xr_runtime.h"

namespace palpa::ar {

/// A session with the runtime, whose calls are all made here, with the context current: its states,
/// its frames, where the eyes are. A call that fails loses the headset; only the constructor throws
/// (Error, XrFailure). One thread at a time, destruction included.
class XrFrames {
 public:
  explicit XrFrames(const GlBinding& gl);

  /// The next frame, with its pictures taken where it is to be drawn. What was left of the last one
  /// is thrown away.
  void next();
  void show(bool drawn);  ///< ends the frame
  void vibrate(std::size_t hand, double seconds, double strength);
  void finish();  ///< ends the session
  void lose(const std::string& why);

  HeadsetState state() const { return state_; }
  const std::string& trouble() const { return trouble_; }
  const std::string& name() const { return runtime_.name; }
  Blend blend() const { return blendOf(runtime_.blend); }
  const HeadsetFrame& frame() const { return frame_; }
  bool ready() const { return begun_; }  ///< a frame has begun and waits for its end
  bool canDraw() const;                  ///< into both pictures
  EyeTexture picture(std::size_t eye) const { return pictures_[eye]->picture(); }

 private:
  template <class Do>
  void guarded(Do act);
  void begin();
  void end(bool drawn);
  void followEvents();
  void follow(const XrEventDataReferenceSpaceChangePending& change);
  void follow(XrSessionState next);
  void locateEyes();
  void keepEyes(const std::array<XrView, 2>& views);
  void stayInPlace(std::array<XrView, 2>* views) const;
  void readControls();

  XrRuntime runtime_;
  XrOwnedSession session_;
  std::array<std::optional<XrEye>, 2> pictures_;
  XrOwnedSpace local_;
  std::optional<XrControls> controls_;
  HeadsetState state_ = HeadsetState::waiting;
  bool begun_ = false, should_draw_ = false;
  bool ever_located_ = false, ever_placed_ = false, first_place_ = false;
  XrTime time_ = 0;
  std::optional<XrTime> moves_at_;  // when L will be somewhere else
  std::array<XrView, 2> views_{};
  HeadsetFrame frame_;
  std::string trouble_;
};

}  // namespace palpa::ar
