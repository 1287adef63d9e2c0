#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/calibrate/sequence.h"

namespace palpa::cli {

/// Of `palpa calibrate camera` and its like: every routine has those of its kind.
struct CalibrateOptions {
  std::optional<station::CalibrationKind> kind;  ///< none: all, one after the other
  std::string station, out, watch;
  std::uint64_t seed = 1;
  bool quiet = false, all_corners = false;
  std::string images, board, pivot, spin, landmarks, pairs, camera_track, device_track, readings,
      touches;
  std::string presses, strokes, without, above, beside, check, mockup = "middle", surface;
  double depth_mm = 0, mass_g = 0;
  std::vector<double> forces_N, speeds_mm_per_s;
  std::vector<double> down{0, 0, -1};

  std::string name() const { return kind ? nameOf(*kind) : "all"; }
  bool recorded() const { return !images.empty() || !tables().empty(); }
  std::vector<std::filesystem::path> tables() const {
    std::vector<std::filesystem::path> given;
    for (const std::string* file :
         {&pivot, &spin, &landmarks, &pairs, &camera_track, &device_track, &readings, &touches,
          &presses, &strokes, &without, &above, &beside, &check})
      if (!file->empty()) given.emplace_back(*file);
    return given;
  }
};

/// From the files that were given. Throws UsageError, Error.
calibrate::Result fromFiles(const CalibrateOptions& options, const station::Station& station,
                            const calibrate::Origin& origin);

/// One routine on the bench: what it needs of the others is taken from the station.
calibrate::Result onBench(const CalibrateOptions& options, const calibrate::Scene& scene,
                          const calibrate::Origin& origin);

}  // namespace palpa::cli
