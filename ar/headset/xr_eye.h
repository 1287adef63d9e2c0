#pragma once

#include <functional>
#include <vector>

#include "ar/headset/headset.h"
#include "ar/headset/xr_call.h"

namespace palpa::ar {

/// The pictures of one eye, handed to and fro between us and the runtime.
class XrEye {
 public:
  XrEye(XrSession session, const XrViewConfigurationView& view, std::int64_t format);
  /// Takes the next picture, has it drawn, and gives it back.
  void draw(const std::function<void(const EyeTexture&)>& draw);
  int width() const { return width_; }
  int height() const { return height_; }
  XrSwapchainSubImage shown() const;
  void leave() { swapchain_.leave(); }  ///< gives nothing back

 private:
  XrOwnedSwapchain swapchain_;
  std::int64_t format_;
  int width_, height_;
  std::vector<std::uint32_t> textures_;
};

/// What both eyes' pictures are made of. Throws XrFailure where nothing suits.
std::int64_t formatFor(XrSession session, Blend blend);

}  // namespace palpa::ar
