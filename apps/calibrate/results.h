#pragma once

#include <optional>
#include <string>
#include <vector>

#include "anatomy/geometry/pose.h"
#include "apps/calibrate/result.h"
#include "calibration/camera_calibration.h"
#include "calibration/camera_model.h"
#include "calibration/clock_offset.h"
#include "calibration/force_sensor.h"
#include "calibration/hand_eye.h"
#include "calibration/registration.h"
#include "calibration/touch/contact_laws.h"
#include "calibration/touch/texture_model.h"

namespace palpa::calibrate {

/// A round tip on a soft sample: where its lowest point was in P, what the sample did to it, how
/// far a lump had moved (where something tells that). At even times, `dt` apart.
struct FeltSample {
  Vec3 p_P = Vec3::Zero(), f_P = Vec3::Zero();  ///< m, N
  std::optional<Vec3> lump_P;                   ///< m
};
struct FeltSamples {
  double dt = 1e-3;  ///< s
  std::vector<FeltSample> samples;
};

/// The same as the estimators want them: depth along -z, its rate over the last step.
std::vector<calibration::PressSample> pressesOf(const FeltSamples& felt);
std::vector<calibration::SlideSample> slidesOf(const FeltSamples& felt);
std::vector<calibration::LumpSample> lumpTouchesOf(const FeltSamples& felt);

/// The first three quarters, to fit; the last, to judge.
FeltSamples toFit(const FeltSamples& felt);
FeltSamples toJudge(const FeltSamples& felt);

}  // namespace palpa::calibrate

/// From samples to what a station keeps, with a verdict from samples that the fit has not seen. All
/// throw Error, in plain words, for data that cannot tell the answer.
namespace palpa::calibrate {

/// Poses of the end effector while the tip rested in a hole, and (or none) while the needle was
/// spun about itself.
struct ToolSamples {
  std::vector<Pose> pivot, spin;
};
/// X_ET: origin at the tip, z along the needle; how the tool is rolled about the needle stays as in
/// `X_ET_design`.
Result toolResult(const ToolSamples& samples, const Pose& X_ET_design, const Origin& origin);

/// A known point of W, touched: where the device said the tip was.
struct Touch {
  std::string name;
  Vec3 p_W = Vec3::Zero(), p_D = Vec3::Zero();
  bool for_check = false;       ///< not used to fit
  Vec3 lever_D = Vec3::Zero();  ///< the tip less the end effector; zero: not known
};
/// A tag on the end effector: X_DE with X_WM in place of X_CM; and, where pictures are at hand, its
/// corners in them, for the same poses.
struct TagSamples {
  std::vector<calibration::HandEyeSample> poses;
  std::vector<calibration::TagView> views;  ///< none: poses alone
  calibration::CameraModel camera;
};

/// X_WD from touched landmarks, from a tag on the end effector (`tag`), or from both: two answers
/// that do not know of each other, so that their disagreement tells of errors that neither could
/// see; joined by their covariances where they agree. `tip_W`: where it matters, for the predicted
/// error.
Result registrationResult(const std::vector<Touch>& touches, const TagSamples& tag,
                          const Vec3& tip_W, const Origin& origin);

/// Where the marker was seen, stamped with the believed time of exposure, and where the device had
/// it. `camera_latency_s`: as believed so far.
struct LatencySamples {
  std::vector<calibration::TimedPoint> camera, device;
};
Result latencyResult(const LatencySamples& samples, double camera_latency_s, const Origin& origin);

Result forceSensorResult(const std::vector<calibration::StaticReading>& readings,
                         const Vec3& down_D, const Origin& origin);

/// What a soft sample is made of, from presses along its normal: H(x, x'); judged by the last
/// quarter of them.
Result materialResult(const FeltSamples& presses, const Origin& origin);
/// What its surface rubs with, from strokes; judged by the last quarter of them.
Result frictionResult(const FeltSamples& strokes, const Origin& origin);
/// What a lump adds to it. `without`: presses of a sample without one; `strokes` of it (none:
/// friction is neglected); `above`, `beside` (strokes over it, too): of one with a lump `depth`
/// below the middle of its top; judged by `check`, presses at a place not used.
struct LumpSamples {
  FeltSamples without, strokes, above;
  std::vector<FeltSamples> beside;
  FeltSamples check;
  double depth = 0;  ///< m
};
Result inclusionResult(const LumpSamples& samples, double tip_radius, const Origin& origin);

/// Strokes over a rough surface, every `dt`, and others to judge by, at forces and speeds that were
/// not used; shaking as the force that shakes the tool.
struct TextureSamples {
  std::vector<calibration::TextureStroke> strokes, check;
  double dt = 1e-3;         ///< s
  double tool_mass = 0.05;  ///< kg
  calibration::TextureGrid grid;
};
/// What shakes a tool on a rough surface, over force and speed; judged by third octaves.
Result textureResult(const TextureSamples& samples, const Origin& origin);

/// The map is of the end effector's places where the touches know their lever. `found`: where it
/// goes; may be null.
Result workspaceResult(const std::vector<Touch>& touches, const Origin& origin,
                       calibration::WorkspaceMap* found = nullptr);

/// The lens from views of a board, all of them; how good it is from every fifth view, predicted by
/// what the others tell (its pose from half of its corners, the error from the other half).
/// `found`: where the model goes. `keep_all`: plain least squares, as in programs that know no
/// outliers. Throws Error for views that cannot tell a lens.
Result cameraResult(const std::vector<calibration::BoardView>& views, int width, int height,
                    const Origin& origin, calibration::CameraModel* found, bool keep_all = false);

}  // namespace palpa::calibrate
