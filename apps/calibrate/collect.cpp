#include "apps/calibrate/collect.h"

#include <cmath>
#include <map>
#include <utility>

#include "anatomy/base/error.h"
#include "calibration/rotation.h"

namespace palpa::calibrate {
namespace {

using runtime::Request;
using runtime::RigMoment;
constexpr std::size_t kTouchReadings = 25;
constexpr double kMostTremor = 4e-4;      // m rms while a tip rests in its hole
constexpr double kMostTremorHeld = 1e-3;  // m rms, in the air
constexpr int kTries = 3;
constexpr std::size_t kEveryPivotReading = 4;  // 25 Hz: neighbours tell nothing new

/// A stretch of readings with the button down, and the pictures that came meanwhile.
struct Stretch {
  std::vector<Pose> X_DE;
  std::vector<haptics::WrenchSample> wrenches;
  std::vector<ar::Frame> pictures;
};

/// Until `readings` were taken with the button down.
Stretch whilePressed(const Scene& scene, const Request& request, std::size_t readings,
                     std::size_t most_pictures) {
  scene.guide.ask(request.words);
  scene.rig.ask(request);
  Stretch stretch;
  double begun = -1, down_since = 0;
  bool down = false;
  while (stretch.X_DE.size() < readings) {
    const RigMoment moment = need(scene.rig, "calibration");
    if (begun < 0) begun = moment.t;
    if (moment.t - begun > kPatience)
      throw Error("nobody pressed the button for a minute", request.words,
                  "Begin again when somebody is at the device");
    if (moment.reading) {
      const bool was_down = std::exchange(down, pressed(*moment.reading));
      if (!down) continue;
      if (!was_down) down_since = moment.t;
      stretch.X_DE.push_back(poseOf(*moment.reading));
      if (moment.wrench && !(moment.wrench->flags & haptics::kFault))
        stretch.wrenches.push_back(*moment.wrench);
    } else if (down && stretch.pictures.size() < most_pictures) {
      std::optional<ar::Frame> frame = moment.picture();
      if (frame && 1e-9 * static_cast<double>(frame->t_exposure_ns) >= down_since)
        stretch.pictures.push_back(std::move(*frame));
    }
  }
  return stretch;
}

Pose meanPose(const std::vector<Pose>& poses) {
  Vec3 p = Vec3::Zero();
  Mat3 R = Mat3::Zero();
  for (const Pose& X : poses) {
    p += X.translation();
    R += X.rotation();
  }
  return makePose(calibration::nearestRotation(R), p / static_cast<double>(poses.size()));
}

double unrest(const std::vector<Pose>& poses, const Pose& mean) {
  double squares = 0;
  for (const Pose& X : poses) squares += (X.translation() - mean.translation()).squaredNorm();
  return std::sqrt(squares / static_cast<double>(poses.size()));
}

/// The same, asked again while the hand was not still.
Stretch whileStill(const Scene& scene, Request request, double most_tremor, std::size_t pictures) {
  const std::string words = request.words;
  for (int i = 0;; ++i) {
    Stretch stretch = whilePressed(scene, request, kTouchReadings, pictures);
    if (unrest(stretch.X_DE, meanPose(stretch.X_DE)) < most_tremor) return stretch;
    if (i + 1 == kTries)
      throw Error("the hand was not still in three tries", words,
                  "Rest it on the table, and begin again");
    request.words = "Not still enough. Once more: " + words;
  }
}

std::vector<Pose> thinned(const std::vector<Pose>& poses) {
  std::vector<Pose> kept;
  for (std::size_t i = 0; i < poses.size(); i += kEveryPivotReading) kept.push_back(poses[i]);
  return kept;
}

std::vector<Pose> collectMotion(const Scene& scene, Request::What what, const std::string& words,
                                const Vec3& p_W, double seconds) {
  Request request;
  request.what = what;
  request.words = words;
  request.p_W = p_W;
  request.seconds = seconds;
  return thinned(whilePressed(scene, request, static_cast<std::size_t>(100 * seconds), 0).X_DE);
}

/// Both boards.
struct Seen {
  std::vector<ar::BoardPoint> marker_points;
  std::optional<ar::BoardPose> board, marker;
};

/// Points that all pictures show, at their mean place: a hand held still trembles about it.
std::vector<ar::BoardPoint> meanPoints(const std::vector<std::vector<ar::BoardPoint>>& pictures) {
  std::map<std::pair<double, double>, std::pair<ar::BoardPoint, std::size_t>> sums;
  for (const auto& points : pictures)
    for (const ar::BoardPoint& point : points) {
      auto& [sum, count] = sums.try_emplace({point.p_W.x(), point.p_W.y()},
                                            ar::BoardPoint{point.p_W, Eigen::Vector2d::Zero()}, 0)
                               .first->second;
      sum.pixel += point.pixel;
      ++count;
    }
  std::vector<ar::BoardPoint> means;
  for (auto& [place, entry] : sums)
    if (entry.second == pictures.size())
      means.push_back({entry.first.p_W, entry.first.pixel / static_cast<double>(pictures.size())});
  return means;
}

class TwoBoards {
 public:
  TwoBoards(const station::Station& station, const calibration::CameraModel& camera)
      : camera_(camera), board_(ar::makeBoard(station.board, station.decimate)) {
    if (!station.marker)
      throw Error("has no \"marker\" on the tool", station.file.name(),
                  "Add one, or register by landmarks alone");
    marker_ = ar::makeBoard(*station.marker, station.decimate);
  }
  /// In one picture, or in several of the same pose.
  Seen see(const std::vector<cv::Mat>& images) const {
    std::vector<std::vector<ar::BoardPoint>> board, marker;
    for (const cv::Mat& image : images) {
      board.push_back(board_->detect(image));
      marker.push_back(marker_->detect(image));
    }
    Seen seen;
    seen.marker_points = meanPoints(marker);
    seen.board = ar::estimateBoardPose(meanPoints(board), camera_);
    seen.marker = ar::estimateBoardPose(seen.marker_points, camera_);
    return seen;
  }

 private:
  calibration::CameraModel camera_;
  std::unique_ptr<ar::Board> board_, marker_;
};

/// Places before the camera, low over the table, the tool leaning every way.
Request heldRequest(int i) {
  Request request;
  request.what = Request::What::hold;
  const double across = (i % 4 - 1.5) / 1.5, along = (i / 4 % 3 - 1.0), up = (i * 7 % 5) / 4.0;
  request.p_W = Vec3(0.05 * across, 0.17 + 0.035 * along, 0.01 + 0.05 * up);
  const double round = 2.4 * i;  // the golden angle: every way, none twice
  request.lean = Vec3(0.4 * std::cos(round), 0.4 * std::sin(round), 0.35 * std::sin(1.7 * i));
  request.words =
      "Hold the tool still where the camera sees its tags, leaning another way than before, and "
      "press the button";
  return request;
}

}  // namespace

std::vector<Pose> collectPivot(const Scene& scene, const Vec3& p_W, double seconds) {
  return collectMotion(scene, Request::What::pivot,
                       "Put the tip into the hole, press the button, and tilt the tool every way "
                       "without leaving the hole",
                       p_W, seconds);
}

std::vector<Pose> collectSpin(const Scene& scene, const Vec3& p_W, double seconds) {
  return collectMotion(
      scene, Request::What::spin,
      "Put the needle into the guide, press the button, and spin it about itself, to and fro", p_W,
      seconds);
}

std::vector<TouchedPose> collectTouches(const Scene& scene,
                                        const std::vector<station::Landmark>& landmarks) {
  std::vector<TouchedPose> touched;
  const auto count = static_cast<int>(landmarks.size());
  for (const station::Landmark& landmark : landmarks) {
    Request request;
    request.what = Request::What::touch;
    request.p_W = landmark.p_W;
    request.words = "Put the tip into hole " + landmark.name + " and press the button";
    const Stretch stretch = whileStill(scene, request, kMostTremor, 0);
    touched.push_back({landmark.name, landmark.p_W, meanPose(stretch.X_DE), landmark.for_check});
    scene.guide.progress("Holes touched", static_cast<int>(touched.size()), count, "");
  }
  return touched;
}

std::vector<Touch> touchesOf(const std::vector<TouchedPose>& poses, const Vec3& tip_E) {
  std::vector<Touch> touches;
  for (const TouchedPose& t : poses)
    touches.push_back({t.name, t.p_W, t.X_DE * tip_E, t.for_check, t.X_DE.rotation() * tip_E});
  return touches;
}

std::vector<HeldPose> collectHeld(const Scene& scene, const calibration::CameraModel& camera,
                                  int poses) {
  const TwoBoards boards(scene.station, camera);
  std::vector<HeldPose> held;
  int seen = 0;
  for (int i = 0; i < poses; ++i) {
    const Stretch stretch = whileStill(scene, heldRequest(i), kMostTremorHeld, 3);
    HeldPose pose;
    pose.X_DE = meanPose(stretch.X_DE);
    std::vector<cv::Mat> images;
    for (const ar::Frame& picture : stretch.pictures) images.push_back(picture.image);
    const Seen s = boards.see(images);
    pose.seen = s.board && s.marker;
    if (pose.seen) {
      pose.X_WM = s.board->X_CW.inverse() * s.marker->X_CW;
      pose.view.X_DE = pose.X_DE;
      pose.view.X_CW = s.board->X_CW;
    }
    for (const ar::BoardPoint& point : s.marker_points) {
      pose.view.p_M.push_back(point.p_W);
      pose.view.pixels.push_back(point.pixel);
    }
    for (const haptics::WrenchSample& w : stretch.wrenches) {
      pose.f_S += unpack(w.f_S) / static_cast<double>(stretch.wrenches.size());
      pose.m_S += unpack(w.tau_S) / static_cast<double>(stretch.wrenches.size());
    }
    held.push_back(pose);
    seen += pose.seen;
    scene.guide.progress("Poses of the tool", i + 1, poses, "tags seen in " + std::to_string(seen));
  }
  return held;
}

LatencySamples collectWave(const Scene& scene, const calibration::CameraModel& camera,
                           const Vec3& p_EM, double seconds) {
  const TwoBoards boards(scene.station, camera);
  Request request;
  request.what = Request::What::wave;
  request.p_W = Vec3(0, 0.17, 0.04);
  request.seconds = seconds;
  request.words =
      "Press the button and wave the tool before the camera, this way and that, never twice the "
      "same";
  scene.guide.ask(request.words);
  scene.rig.ask(request);
  LatencySamples samples;
  double begun = -1, last = 0;
  for (double first = -1; begun < 0 || last - begun < seconds;) {
    const RigMoment moment = need(scene.rig, "calibration of the time");
    if (first < 0) first = moment.t;
    last = moment.t;
    if (begun < 0 && moment.t - first > kPatience)
      throw Error("nobody pressed the button for a minute", request.words, "Begin again");
    if (moment.reading) {
      const Pose X_DE = poseOf(*moment.reading);
      samples.device.push_back({1e-9 * static_cast<double>(moment.reading->t_ns), X_DE * p_EM});
      if (begun < 0 && pressed(*moment.reading)) begun = moment.t;
    } else if (begun >= 0) {
      const std::optional<ar::Frame> frame = moment.picture();
      if (!frame) continue;
      const Seen s = boards.see({frame->image});
      if (!s.board || !s.marker) continue;
      samples.camera.push_back({1e-9 * static_cast<double>(frame->t_exposure_ns),
                                s.board->X_CW.inverse() * s.marker->X_CW.translation()});
      if (samples.camera.size() % 15 == 0)
        scene.guide.progress("Motion before the camera", static_cast<int>(last - begun),
                             static_cast<int>(seconds),
                             std::to_string(samples.camera.size()) + " pictures");
    }
  }
  return samples;
}

}  // namespace palpa::calibrate
