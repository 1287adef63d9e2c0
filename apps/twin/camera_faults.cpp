#include "apps/twin/camera_faults.h"

#include <opencv2/imgproc.hpp>

#include "anatomy/geometry/error.h"
#include "apps/twin/fault_spans.h"

namespace palpa::twin {
namespace {

using Kind = CameraFault::Kind;
constexpr int kCloth = 110, kDark = 30;  // a gray level; by what a covered lens divides the light

constexpr std::pair<const char*, Kind> kCameraFaults[] = {
    {"hidden", Kind::hidden},         {"black", Kind::black}, {"frozen", Kind::frozen},
    {"wrong_size", Kind::wrong_size}, {"gone", Kind::gone},   {"ended", Kind::ended}};

}  // namespace

std::vector<CameraFault> readCameraFaults(const station::JsonFile& file) {
  return readFaults<CameraFault>(
      file, "camera_faults", [](const station::JsonFile& entry, double from, double to) {
        return CameraFault{faultKind<Kind>(entry, kCameraFaults), from, to};
      });
}

const CameraFault* faultAt(const std::vector<CameraFault>& faults, double t) {
  for (const CameraFault& fault : faults)
    if (t >= fault.from && (t < fault.to || fault.kind == Kind::ended)) return &fault;
  return nullptr;
}

std::optional<ar::Frame> spoilt(ar::Frame frame, const CameraFault& fault) {
  switch (fault.kind) {
    case Kind::hidden:
      frame.image.setTo(kCloth);
      return frame;
    case Kind::black:
      frame.image /= kDark;
      return frame;
    case Kind::wrong_size:
      cv::resize(frame.image, frame.image, frame.image.size() / 2);
      return frame;
    case Kind::gone:
      throw Error("no picture within a second", frame.source, "Look at its cable");
    case Kind::ended:
      return std::nullopt;
    case Kind::frozen:
      break;  // the caller shows the same moment again
  }
  return frame;
}

}  // namespace palpa::twin
