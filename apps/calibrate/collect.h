#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "anatomy/base/error.h"
#include "apps/calibrate/results.h"
#include "apps/runtime/rig.h"
#include "apps/station/station_file.h"
#include "ar/tracking/board_pose.h"
#include "calibration/camera_calibration.h"
#include "calibration/hand_eye.h"

/// What every collector does with a station's moments.
namespace palpa::calibrate {

inline constexpr double kPatience = 60;  ///< s without an answer: the person has left

inline runtime::RigMoment need(runtime::Rig& rig, const char* what) {
  std::optional<runtime::RigMoment> moment = rig.next();
  if (!moment) throw Error("the station ended while it was set up", what, "Begin again");
  return *moment;
}

inline Pose poseOf(const haptics::DeviceReading& reading) {
  return unpack(PackedPose{reading.p_DE, reading.q_DE});
}

inline bool pressed(const haptics::DeviceReading& reading) {
  return (reading.buttons & runtime::kMarkButton) != 0;
}

}  // namespace palpa::calibrate

/// Collects what a calibration needs from a station: asks, watches, takes what is good, asks again
/// for what is not.
namespace palpa::calibrate {

/// Tells a person how it goes.
class Guide {
 public:
  virtual ~Guide() = default;
  virtual void ask(const std::string& words) = 0;
  /// `live`: what is known so far, in words.
  virtual void progress(const std::string& what, int done, int of, const std::string& live) = 0;
  /// The board's points in the view just taken, and where in the picture it has been seen so far.
  virtual void covered(const std::vector<ar::BoardPoint>&, const calibration::CoverageMap&) {}
};

/// Where a collector works.
struct Scene {
  const station::Station& station;
  runtime::Rig& rig;
  Guide& guide;
};

/// The station's board, held before the camera in views that together tell the lens.
std::vector<calibration::BoardView> collectViews(const Scene& scene, int views = 20);

/// Poses of the end effector while the tip is in the hole at `p_W`.
std::vector<Pose> collectPivot(const Scene& scene, const Vec3& p_W, double seconds = 12);
std::vector<Pose> collectSpin(const Scene& scene, const Vec3& p_W, double seconds = 6);

/// The station's landmarks touched one after the other: mean pose of the end effector at each.
struct TouchedPose {
  std::string name;
  Vec3 p_W = Vec3::Zero();
  Pose X_DE = Pose::Identity();
  bool for_check = false;
};
std::vector<TouchedPose> collectTouches(const Scene& scene,
                                        const std::vector<station::Landmark>& landmarks);
/// With the tool that was found.
std::vector<Touch> touchesOf(const std::vector<TouchedPose>& poses, const Vec3& tip_E);

/// The tool held still in `poses` places where the camera sees its marker: X_DE, the marker's pose
/// in W, its corners (means of up to three pictures), and what the force sensor showed.
struct HeldPose {
  Pose X_DE = Pose::Identity(), X_WM = Pose::Identity();
  bool seen = false;
  calibration::TagView view;
  Vec3 f_S = Vec3::Zero(), m_S = Vec3::Zero();
};
std::vector<HeldPose> collectHeld(const Scene& scene, const calibration::CameraModel& camera,
                                  int poses = 20);

/// The tool waved before the camera: the marker in the camera's frame by the camera's clock, p_DE +
/// R_DE p_EM by the device's.
LatencySamples collectWave(const Scene& scene, const calibration::CameraModel& camera,
                           const Vec3& p_EM, double seconds = 12);

/// Where the tip is put on the sample, m across P, and what for.
struct FeltPlace {
  double across = 0, along = 0;
};

/// Pressed slowly and quickly, at one place; `sample` as in a Request. Throws Error, and UsageError
/// for a station without force sensor or sample.
FeltSamples collectPresses(const Scene& scene, const std::string& sample, const FeltPlace& place,
                           double seconds);
/// Stroked to and fro over the middle.
FeltSamples collectStrokes(const Scene& scene, const std::string& sample, double seconds);

/// A table: t_s; x_, y_, z_ (m or mm) of the tip's lowest point, z up from the sample's top;
/// force_x_N, ...; optional lump_x_, .... Times must be even. Throws Error.
FeltSamples readFelt(const std::filesystem::path& file);

}  // namespace palpa::calibrate
