#include "apps/bench/setup_accuracy.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "apps/station/overlay_error.h"
#include "calibration/rotation.h"

namespace palpa::bench {
namespace {

/// The board as the calibrated station sees it in the bench's next picture.
ar::BoardPose seenBoard(const station::Station& station, twin::SetupBench& bench) {
  const auto board = ar::makeBoard(station.board, station.decimate);
  for (;;) {
    const std::optional<runtime::RigMoment> moment = bench.next();
    if (!moment->picture) continue;
    if (const auto pose =
            ar::estimateBoardPose(board->detect(moment->picture()->image), station.camera))
      return *pose;
    throw Error("does not see the board at the end", "virtual bench",
                "Look at the station's camera and board");
  }
}

/// Where the end effector truly is when the calibrated station believes it at p_DE.
Vec3 truePlace(const Vec3& p_DE, const station::Station& station, const twin::DeviceTruth& device) {
  constexpr int kRounds = 20;  // each a hundredth of the former's error
  Vec3 said = p_DE, truth = p_DE;
  for (int i = 0; i < kRounds; ++i)
    said -= unpack(haptics::corrected(station.workspace, pack(said))) - p_DE;
  for (int i = 0; i < kRounds; ++i) truth = said - device.position_error.at(truth);
  return truth;
}

}  // namespace

SetupAccuracy measureAccuracy(const station::Station& before, const station::Station& calibrated,
                              const calibrate::SetupResult& setup, twin::SetupBench& bench) {
  SetupAccuracy a;
  a.seconds = setup.seconds;
  const twin::WorldTruth& truth = bench.truth();
  a.tip_mm = 1e3 * (calibrated.X_ET.translation() - truth.X_ET.translation()).norm();
  const Pose X_DE = calibrated.X_WD.inverse() *
                    makePose(calibration::halfTurnAboutX(), calibrated.entry_W) *
                    calibrated.X_ET.inverse();
  const Pose X_DE_true =
      makePose(X_DE.rotation(), truePlace(X_DE.translation(), calibrated, bench.device()));
  const Vec3 thought_W = (calibrated.X_WD * X_DE * calibrated.X_ET).translation(),
             true_W = (truth.X_WD * X_DE_true * truth.X_ET).translation();
  a.target_mm = 1e3 * (thought_W - true_W).norm();
  const ar::BoardPose board = seenBoard(calibrated, bench);
  a.target_px = (calibrated.camera.project(board.X_CW * thought_W) -
                 bench.trueCamera().project(bench.X_CW() * true_W))
                    .norm();
  if (const auto predicted = station::predictOverlayError(calibrated, X_DE, board)) {
    a.predicted_mm = predicted->mm;
    a.predicted_px = predicted->px;
  }
  if (const station::AppliedCalibration* latency =
          station::calibrationOf(setup.calibrations, station::CalibrationKind::latency)) {
    const double t = latency->file.at("at_s", 1)[0];
    const double true_offset =
        before.camera_latency_s - truth.camera_latency_s + truth.clock_drift * t;
    a.offset_ms = 1e3 * (latency->file.at("offset_s", 1)[0] - true_offset);
    a.offset_sd_ms = 1e3 * std::sqrt(latency->file.covariance(0, 0));
  }
  return a;
}

std::vector<std::string> inWords(const SetupAccuracy& a) {
  using calibrate::quantity;
  return {"Needle's tip on the handle: off by " + quantity(a.tip_mm, "mm") + ".",
          "Overlay at the needle's tip: off by " + quantity(a.target_mm, "mm") + " (predicted " +
              quantity(a.predicted_mm, "mm") + ") and " + quantity(a.target_px, "px") +
              " (predicted " + quantity(a.predicted_px, "px") + ").",
          "Time between camera and device: off by " + quantity(a.offset_ms, "ms") + "."};
}

std::string inJson(const SetupAccuracy& a) {
  return nlohmann::json{{"simulated", true},
                        {"tip_mm", a.tip_mm},
                        {"target_mm", a.target_mm},
                        {"target_px", a.target_px},
                        {"predicted_mm", a.predicted_mm},
                        {"predicted_px", a.predicted_px},
                        {"offset_ms", a.offset_ms},
                        {"offset_sd_ms", a.offset_sd_ms},
                        {"seconds", a.seconds}}
      .dump();
}

}  // namespace palpa::bench
