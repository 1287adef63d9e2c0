#pragma once

#include <vector>

#include "ar/headset/headset.h"
#include "ar/headset/xr_call.h"

namespace palpa::ar {

/// The pictures of one eye, handed to and fro between us and the runtime.
class XrEye {
 public:
  XrEye(XrSession session, const XrViewConfigurationView& view, std::int64_t format);
  void take();  ///< the next picture, to be drawn into
  bool taken() const { return taken_; }
  EyeTexture picture() const;  ///< that was taken
  void giveBack();             ///< if one was taken
  int width() const { return width_; }
  int height() const { return height_; }
  XrSwapchainSubImage shown() const;

 private:
  XrOwnedSwapchain swapchain_;
  std::int64_t format_;
  int width_, height_;
  std::vector<std::uint32_t> textures_;
  std::uint32_t current_ = 0;
  bool taken_ = false;
};

/// What both eyes' pictures are made of. Throws XrFailure where nothing suits.
std::int64_t formatFor(XrSession session, Blend blend);

}  // namespace palpa::ar
