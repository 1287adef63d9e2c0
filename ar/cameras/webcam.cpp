#include "ar/cameras/webcam.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "anatomy/base/error.h"
#include "ar/codecs/codecs.h"

namespace palpa::ar {
namespace {

constexpr double kManualExposure = 1;  // V4L2_EXPOSURE_MANUAL
constexpr double kExposureUnits = 10;  // V4L2_CID_EXPOSURE_ABSOLUTE counts tenths of a millisecond

std::string sizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

}  // namespace

struct Webcam::Impl {
  WebcamSettings settings;
  std::unique_ptr<cv::VideoCapture> camera = makeVideoCapture();
  std::uint64_t next = 0;

  bool set(int property, double value) { return camera->set(property, value); }
};

Webcam::Webcam(const WebcamSettings& settings) : impl_(std::make_unique<Impl>()) {
  impl_->settings = settings;
  if (!std::filesystem::exists(settings.device))
    throw Error("there is no such camera", settings.device,
                "Plug it in, and look which /dev/video* it is");
  cv::VideoCapture& camera = *impl_->camera;
  if (!camera.open(settings.device, cv::CAP_V4L2))
    throw Error("cannot be opened", settings.device,
                "Close other programs that use the camera; your user must be in the group video");
  // Raw pictures are too many for USB 2 beyond 640x480.
  impl_->set(cv::CAP_PROP_FOURCC, fourcc("MJPG"));
  impl_->set(cv::CAP_PROP_FRAME_WIDTH, settings.width);
  impl_->set(cv::CAP_PROP_FRAME_HEIGHT, settings.height);
  impl_->set(cv::CAP_PROP_FPS, settings.rate_Hz);
  impl_->set(cv::CAP_PROP_BUFFERSIZE, 1);
  const int width = static_cast<int>(camera.get(cv::CAP_PROP_FRAME_WIDTH)),
            height = static_cast<int>(camera.get(cv::CAP_PROP_FRAME_HEIGHT));
  if (settings.adjusts) return;
  if (width != settings.width || height != settings.height)
    throw Error(
        "gives pictures of " + sizeText(width, height) + ", not of " +
            sizeText(settings.width, settings.height),
        settings.device,
        "Put a size into the station's file that the camera has, and calibrate it at that size");
  const auto ask = [&](int property, double value, const char* words) {
    if (!impl_->set(property, value)) remarks_.push_back(words);
  };
  ask(cv::CAP_PROP_AUTO_EXPOSURE, kManualExposure, "the camera does not let its exposure be fixed");
  ask(cv::CAP_PROP_EXPOSURE, std::max(1.0, std::round(settings.exposure_ms * kExposureUnits)),
      "the camera does not take an exposure time");
  ask(cv::CAP_PROP_AUTOFOCUS, 0, "the camera does not say that its focus is fixed");
  ask(cv::CAP_PROP_AUTO_WB, 0, "the camera does not let its white balance be fixed");
  if (settings.gain >= 0) ask(cv::CAP_PROP_GAIN, settings.gain, "the camera does not take a gain");
  if (settings.focus >= 0)
    ask(cv::CAP_PROP_FOCUS, settings.focus, "the camera does not take a focus");
}

Webcam::~Webcam() = default;

std::optional<Frame> Webcam::grab() {
  Frame frame;
  bool read = false;
  try {
    read = impl_->camera->read(frame.image);
  } catch (const cv::Exception&) {
  }
  if (!read || frame.image.empty())
    throw Error("gives no pictures any more", impl_->settings.device, "Look at its cable");
  frame.t_exposure_ns = std::llround(1e6 * impl_->camera->get(cv::CAP_PROP_POS_MSEC));
  frame.number = impl_->next++;
  frame.source = impl_->settings.device;
  return frame;
}

}  // namespace palpa::ar
