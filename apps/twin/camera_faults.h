#pragma once

#include <optional>
#include <vector>

#include "apps/station/json_file.h"
#include "ar/camera.h"

namespace palpa::twin {

/// What shall go wrong with the virtual camera, and when: "twin/camera_faults" of a station's file,
/// a list of {"kind", "from_s", "to_s"}; session time.
///   hidden      something lies over the board     black       the lens is covered         frozen
///   the same picture over and over wrong_size  pictures of half the size         gone        the
///   driver reports an error ended    no more pictures, also afterwards
struct CameraFault {
  enum class Kind { hidden, black, frozen, wrong_size, gone, ended };
  Kind kind = Kind::black;
  double from = 0, to = 0;  ///< s
};

/// Throws UsageError for a kind that is not known and for spans that are none.
std::vector<CameraFault> readCameraFaults(const station::JsonFile& file);

/// The one that holds at a time; nullptr: none.
const CameraFault* faultAt(const std::vector<CameraFault>& faults, double t);

/// The picture as the fault leaves it. Throws Error where the camera is gone.
std::optional<ar::Frame> spoilt(ar::Frame frame, const CameraFault& fault);

}  // namespace palpa::twin
