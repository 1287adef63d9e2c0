#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/cli/needle_world.h"
#include "apps/runtime/camera_activity.h"
#include "apps/twin/virtual_bench.h"

namespace palpa::cli {

/// One registered (or not) recorded picture, for registration.csv.
struct RegistrationRow {
  std::string source;
  int points = 0;
  double rms_px = 0;
  Pose X_CW = Pose::Identity();
};

/// Where a session's pictures come from, and what board is looked for in them: the bench's camera, or recorded files,
/// one after the other, over and over. Throws UsageError when pictures and intrinsics do not fit.
class SessionPictures {
 public:
  SessionPictures(const SessionOptions& options, const NeedleWorld& world);
  ~SessionPictures();

  bool recorded() const { return recorded_ != nullptr; }
  const calibration::CameraModel& camera() const { return camera_; }
  const ar::Board& board() const { return *board_; }
  runtime::CameraActivity::Settings settings(runtime::TimeMode mode) const;
  /// `bench` is asked only where nothing is recorded.
  runtime::CameraActivity::Exposer exposer(twin::VirtualBench* bench);
  runtime::CameraActivity::Observer observer(twin::VirtualBench* bench);
  const std::vector<RegistrationRow>& registration() const { return registration_; }   ///< of recorded pictures

 private:
  class Loop;
  void note(const runtime::CameraView& view);

  const station::Station& station_;
  calibration::CameraModel camera_;
  std::unique_ptr<Loop> recorded_;
  std::unique_ptr<ar::Board> board_;
  std::vector<RegistrationRow> registration_;
};

}  // namespace palpa::cli
