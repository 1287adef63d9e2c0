#include "apps/twin/camera_faults.h"

#include <opencv2/imgproc.hpp>

#include "anatomy/geometry/error.h"

namespace palpa::twin {
namespace {

using Kind = CameraFault::Kind;
constexpr double kLongestSession = 86'400;   // s
constexpr int kCloth = 110, kDark = 30;      // a gray level; by what a covered lens divides the light

struct Name {
  const char* name;
  Kind kind;
};
constexpr Name kNames[] = {{"hidden", Kind::hidden}, {"black", Kind::black}, {"frozen", Kind::frozen}, {"wrong_size", Kind::wrong_size}, {"gone", Kind::gone}, {"ended", Kind::ended}};

Kind kindIn(const station::JsonFile& entry) {
  const std::string said = entry.text("kind");
  for (const Name& known : kNames)
    if (said == known.name) return known.kind;
  entry.refuse("kind", "is \"" + said + "\"; known are hidden, black, frozen, wrong_size, gone, ended");
}

}  // namespace

std::vector<CameraFault> readCameraFaults(const station::JsonFile& file) {
  std::vector<CameraFault> faults;
  if (!file.has("twin/camera_faults")) return faults;
  const nlohmann::json& list = file.json().at("twin").at("camera_faults");
  if (!list.is_array()) file.refuse("twin/camera_faults", "must be a list");
  for (const nlohmann::json& item : list) {
    const station::JsonFile entry(item, file.name() + ", \"twin/camera_faults\"");
    faults.push_back({kindIn(entry), entry.number("from_s", 0, kLongestSession), entry.number("to_s", 0, kLongestSession)});
    if (faults.back().to <= faults.back().from) entry.refuse("to_s", "must be later than from_s");
  }
  return faults;
}

const CameraFault* faultAt(const std::vector<CameraFault>& faults, double t) {
  for (const CameraFault& fault : faults)
    if (t >= fault.from && (t < fault.to || fault.kind == Kind::ended)) return &fault;
  return nullptr;
}

std::optional<ar::Frame> spoilt(ar::Frame frame, const CameraFault& fault) {
  switch (fault.kind) {
    case Kind::hidden: frame.image.setTo(kCloth); return frame;
    case Kind::black: frame.image /= kDark; return frame;
    case Kind::wrong_size: cv::resize(frame.image, frame.image, frame.image.size() / 2); return frame;
    case Kind::gone: throw Error("no picture within a second", frame.source, "Look at its cable");
    case Kind::ended: return std::nullopt;
    case Kind::frozen: break;   // the caller shows the same moment again
  }
  return frame;
}

}  // namespace palpa::twin
