#include "ar/headset/xr_eye.h"

#include <algorithm>
#include <utility>

#include "ar/headset/xr_runtime.h"

namespace palpa::ar {
namespace {

constexpr XrDuration kPatience = 100'000'000;  // ns, for a picture that the runtime still reads
constexpr int kTries = 10;                     // after a second it is taken for lost

XrOwnedSwapchain makeSwapchain(XrSession session, int width, int height, std::int64_t format) {
  const XrSwapchainCreateInfo info{
      XR_TYPE_SWAPCHAIN_CREATE_INFO,
      nullptr,
      0,
      XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_SAMPLED_BIT,
      format,
      1,
      static_cast<std::uint32_t>(width),
      static_cast<std::uint32_t>(height),
      1,
      1,
      1};
  XrSwapchain swapchain = XR_NULL_HANDLE;
  xrCheck(xrCreateSwapchain(session, &info, &swapchain), "xrCreateSwapchain");
  return XrOwnedSwapchain(swapchain);
}

}  // namespace

XrEye::XrEye(XrSession session, const XrViewConfigurationView& view, std::int64_t format)
    : format_(format),
      width_(static_cast<int>(std::min(view.recommendedImageRectWidth, view.maxImageRectWidth))),
      height_(
          static_cast<int>(std::min(view.recommendedImageRectHeight, view.maxImageRectHeight))) {
  swapchain_ = makeSwapchain(session, width_, height_, format_);
  textures_ = texturesOf(swapchain_.get());
}

void XrEye::take() {
  xrCheck(xrAcquireSwapchainImage(swapchain_.get(), nullptr, &current_), "xrAcquireSwapchainImage");
  const XrSwapchainImageWaitInfo patience{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, kPatience};
  XrResult waited = XR_TIMEOUT_EXPIRED;
  for (int i = 0; i < kTries && waited == XR_TIMEOUT_EXPIRED; ++i)
    waited = xrCheck(xrWaitSwapchainImage(swapchain_.get(), &patience), "xrWaitSwapchainImage");
  if (waited == XR_TIMEOUT_EXPIRED) throw XrFailure(XR_ERROR_SESSION_LOST, "xrWaitSwapchainImage");
  taken_ = true;
}

EyeTexture XrEye::picture() const { return {textures_.at(current_), format_, width_, height_}; }

void XrEye::giveBack() {
  if (!std::exchange(taken_, false)) return;
  xrCheck(xrReleaseSwapchainImage(swapchain_.get(), nullptr), "xrReleaseSwapchainImage");
}

XrSwapchainSubImage XrEye::shown() const {
  return {swapchain_.get(), {{0, 0}, {width_, height_}}, 0};
}

std::int64_t formatFor(XrSession session, Blend blend) {
  const auto offered = xrListed<std::int64_t>(
      [&](std::uint32_t n, std::uint32_t* count, std::int64_t* out) {
        return xrEnumerateSwapchainFormats(session, n, count, out);
      },
      "xrEnumerateSwapchainFormats");
  const std::int64_t format = chooseFormat(offered, blend);
  if (!format)
    throw XrFailure(XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED, "xrEnumerateSwapchainFormats");
  return format;
}

}  // namespace palpa::ar
