#pragma once

#include <functional>
#include <vector>

#include "apps/station/station_file.h"
#include "apps/twin/tracking_model.h"

/// The tracking model and the pictures that it stands for: measured there, and judged beside them
/// on other seeds.
namespace palpa::bench {

/// Called with the share that is done.
using ShareDone = std::function<void(double)>;

struct TrackingFit {
  std::vector<double> distances{0.45, 0.55, 0.7, 0.85, 1.0};  ///< m
  double most_aside = 0.12, aside_step = 0.02;                ///< share of the distance
  int views = 6;              ///< of each place, each with a lens of its own
  int pictures = 8;           ///< of each view, shifted at random by up to a pixel
  int repeated = 4;           ///< of these, taken a second time
  std::uint64_t seed = 5001;  ///< of the first lens
};

/// Of the station's camera and board, from pictures of the virtual camera.
twin::TrackingFigures fitTracking(const station::Station& station, const TrackingFit& fit,
                                  const ShareDone& done = {});

enum class TrackedBy { pictures, model };

/// One camera on its boom, for so many pictures: what the tracker makes of them, against what it
/// would make of corners without any error (the calibration's share in the error is left out, as it
/// is the same in both).
struct TrackedSession {
  struct Error {
    Vec3 shift_mm, turn_mrad;  ///< of a point at the patient's entry; of the board
  };
  std::vector<Error> measured, filtered;  ///< where there is a pose
  int pictures = 0;
  double tags_missed = 0;  ///< sum over the pictures of the share of tags that are not found
};
TrackedSession trackedSession(const station::Station& station, std::uint64_t seed, int pictures,
                              TrackedBy by, const twin::TrackingFigures& figures);

inline constexpr std::array<int, 4> kTrackingLags{1, 3, 8, 15};  ///< pictures

struct PathFigures {
  double shift_mm = 0, turn_mrad = 0, filtered_shift_mm = 0, filtered_turn_mrad = 0;  ///< rms
  /// of the measured shift about its session's mean
  std::array<double, kTrackingLags.size()> autocorrelation{};
  double tags_missed = 0, poses_missed = 0;  ///< shares
};
PathFigures figuresOf(const std::vector<TrackedSession>& sessions);

}  // namespace palpa::bench
