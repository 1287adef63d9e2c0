#include "apps/bench/bench.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "apps/bench/pictures/tracking_scene.h"
#include "apps/bench/timing.h"
#include "ar/tracking/board_pose.h"
#include "ar/tracking/board_tracker.h"
#include "calibration/rotation.h"

namespace palpa::bench {
namespace {

using ar::BoardTracker;
using ar::Matrix6;
using ar::Vector6;
using nlohmann::json;
const Vec3 kTarget_W(0, 0.12, 0.04);  // where a patient's entry point lies from the board
constexpr double kViewTilt = 35 * kDegree;

std::int64_t ns(double t) { return std::llround(1e9 * t); }

class TrackingBench {
 public:
  explicit TrackingBench(const TrackingBenchOptions& options) : o_(options), scene_(options) {}

  void run() {
    bound();
    stillness();
    motion();
    regionOfInterest();
    recovery();
    falsePoses();
    flips();
  }

 private:
  int count(int all) const { return o_.quick ? std::max(all / 10, 3) : all; }
  double period() const { return 1 / o_.rate_Hz; }
  json params(json more) const {
    more["resolution"] = std::to_string(o_.width) + "x" + std::to_string(o_.height);
    more["data"] = "simulated";
    more["noise"] = "realistic";
    return more;
  }
  Pose view() const { return TrackingScene::view(o_.distance, kViewTilt, 0.4, 0); }

  /// Errors of the pose against what corners of the noise that they truly have permit (Cramer-Rao),
  /// all views together.
  void bound() const {
    RandomStream random(o_.seed, "bench.tracking.bound");
    struct PoseError {
      Vector6 error;
      Matrix6 information;
    };
    std::vector<PoseError> all;
    double squares_px = 0, corners = 0;
    for (int i = 0; i < count(200); ++i) {
      const Pose X = scene_.anyView(random, o_.distance, 55 * kDegree);
      const std::vector<ar::BoardPoint> points =
          scene_.board().detect(scene_.still(X, static_cast<std::uint64_t>(i)));
      const auto pose = ar::estimateBoardPose(points, scene_.camera());
      if (!pose || pose->points < 4 * scene_.spec().columns * scene_.spec().rows) continue;
      for (const ar::BoardPoint& point : points)
        squares_px += (scene_.camera().project(X * point.p_W) - point.pixel).squaredNorm() / 2;
      corners += static_cast<double>(points.size());
      all.push_back({ar::difference(pose->X_CW, X),
                     ar::refinePose(X, exactly(points, X), scene_.camera()).information});
    }
    const double sigma = std::sqrt(squares_px / corners);
    double normalised = 0, shift = 0, shift_bound = 0;
    for (const PoseError& one : all) {
      const Matrix6 covariance = sigma * sigma * one.information.inverse();
      normalised += one.error.dot(one.information * one.error) / (sigma * sigma);
      shift += one.error.tail<3>().squaredNorm();
      shift_bound += covariance.bottomRightCorner<3, 3>().trace();
    }
    const json p =
        params({{"distance_m", o_.distance}, {"speed_m_per_s", 0}, {"views", all.size()}});
    print("pose_rmse_over_crlb", std::sqrt(normalised / (6.0 * static_cast<double>(all.size()))),
          "1", p);
    print("position_rmse_over_crlb", std::sqrt(shift / shift_bound), "1", p);
    print("position_rmse", 1e3 * std::sqrt(shift / static_cast<double>(all.size())), "mm", p);
    print("corner_sigma", sigma, "px", p);
  }

  std::vector<ar::BoardPoint> exactly(std::vector<ar::BoardPoint> points, const Pose& X) const {
    for (ar::BoardPoint& point : points) point.pixel = scene_.camera().project(X * point.p_W);
    return points;
  }

  void stillness() const {
    BoardTracker tracker(scene_.board(), scene_.camera());
    std::vector<Vec3> places;
    const int settle = static_cast<int>(o_.rate_Hz);
    for (int i = 0; i < settle + count(150); ++i) {
      const std::int64_t t = ns(period() * i);
      tracker.see(scene_.still(view(), static_cast<std::uint64_t>(i)), t);
      if (i >= settle) places.push_back(tracker.track().at(t).X * kTarget_W);
    }
    Vec3 mean = Vec3::Zero();
    for (const Vec3& p : places) mean += p / static_cast<double>(places.size());
    double squares = 0;
    for (const Vec3& p : places)
      squares += (p - mean).squaredNorm() / static_cast<double>(places.size());
    print("still_jitter_mm", 1e3 * std::sqrt(squares), "mm",
          params({{"distance_m", o_.distance}, {"speed_m_per_s", 0}, {"rate_Hz", o_.rate_Hz}}));
  }

  /// With the settings of stillness(). Lag: the time shift that explains most of the difference,
  /// sum e'v / sum v'v.
  void motion() const {
    BoardTracker tracker(scene_.board(), scene_.camera());
    const HandMotion hand(view(), o_.speed);
    double along = 0, speeds = 0, mm = 0, px = 0, mm2 = 0;
    int n = 0;
    const int settle = static_cast<int>(o_.rate_Hz) / 2;
    for (int i = 0; i < settle + count(180); ++i) {
      const double t = period() * i;
      tracker.see(scene_.moving(hand, t, static_cast<std::uint64_t>(i)), ns(t));
      if (i < settle) continue;
      const Vec3 v = hand.velocity(t, kTarget_W),
                 behind = hand(t) * kTarget_W - tracker.track().at(ns(t)).X * kTarget_W;
      along += behind.dot(v);
      speeds += v.squaredNorm();
      const double shown = t + 1e-3 * o_.horizon_ms;
      const Vec3 drawn = tracker.track().at(ns(shown)).X * kTarget_W,
                 truth = hand(shown) * kTarget_W;
      mm += 1e3 * (drawn - truth).norm();
      mm2 += 1e6 * (drawn - truth).squaredNorm();
      px += (scene_.camera().project(drawn) - scene_.camera().project(truth)).norm();
      ++n;
    }
    const json p = params({{"distance_m", o_.distance},
                           {"speed_m_per_s", o_.speed},
                           {"rate_Hz", o_.rate_Hz},
                           {"horizon_ms", o_.horizon_ms}});
    print("motion_lag_ms", 1e3 * along / speeds, "ms", p);
    print("overlay_error_mm", mm / n, "mm", p);
    print("overlay_error_mm_rms", std::sqrt(mm2 / n), "mm", p);
    print("overlay_error_px", px / n, "px", p);
  }

  /// The whole step, board expected against board unknown, over the same pictures.
  void regionOfInterest() const {
    constexpr int kPictures = 8;
    std::vector<cv::Mat> pictures;
    for (int i = 0; i < kPictures; ++i)
      pictures.push_back(scene_.still(view(), static_cast<std::uint64_t>(i)));
    BoardTracker expecting(scene_.board(), scene_.camera()),
        searching(scene_.board(), scene_.camera(), {{}, false});
    std::int64_t number = 0;
    for (; number < 10; ++number)
      expecting.see(pictures[0], ns(period() * static_cast<double>(number)));
    const auto tracked = [&](int i) {
      expecting.see(pictures[static_cast<std::size_t>(i)],
                    ns(period() * static_cast<double>(number++)));
    };
    const auto searched = [&](int i) { searching.see(pictures[static_cast<std::size_t>(i)], 0); };
    const Ratio ratio = compareQueries(o_.quick ? 3 : 11, kPictures, tracked, searched);
    const json p = params({{"distance_m", o_.distance}, {"speed_m_per_s", 0}});
    print("roi_speedup", ratio.median, "1", p);
    print("roi_speedup_low", ratio.interval.low, "1", p);
    print("roi_speedup_high", ratio.interval.high, "1", p);
    print("tracked_picture",
          1e-3 * timeQueries(16, [&](int i) { tracked(i % kPictures); }).median_us, "ms", p);
  }

  /// Pictures after an occlusion until the pose is there again and true; the board meanwhile
  /// carried elsewhere.
  void recovery() const {
    RandomStream random(o_.seed, "bench.tracking.recovery");
    int worst = 0;
    std::uint64_t number = 0;
    const cv::Mat hidden(o_.height, o_.width, CV_8U, cv::Scalar(90));
    for (int trial = 0; trial < count(20); ++trial) {
      BoardTracker tracker(scene_.board(), scene_.camera());
      double t = 0;
      const Pose before = view();
      for (int i = 0; i < 6; ++i, t += period()) tracker.see(scene_.still(before, number++), ns(t));
      const int gap = 1 + static_cast<int>(40 * random.uniform());
      for (int i = 0; i < gap; ++i, t += period()) tracker.see(hidden, ns(t));
      Pose after = before;
      after.translation() +=
          std::min(0.08, o_.speed * gap * period()) *
          Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      int pictures = 1;
      for (; pictures < 10; ++pictures, t += period())
        if (tracker.see(scene_.still(after, number++), ns(t)) &&
            (tracker.track().at(ns(t)).X * kTarget_W - after * kTarget_W).norm() < 1e-3)
          break;
      worst = std::max(worst, pictures);
    }
    print(
        "recovery_frames", worst, "pictures",
        params(
            {{"distance_m", o_.distance}, {"speed_m_per_s", o_.speed}, {"occlusions", count(20)}}));
  }

  void falsePoses() const {
    const int pictures = count(2000);
    int poses = 0;
    BoardTracker tracker(scene_.board(), scene_.camera());
    for (int i = 0; i < pictures; ++i)
      poses += tracker.see(falsePicture(i, {o_.width, o_.height}, o_.seed), ns(period() * i))
                   .has_value();
    print("false_poses", poses, "poses",
          params({{"pictures", pictures}, {"of", "noise, text, tags of other families"}}));
  }

  /// A flip: the board's normal is nearer to its mirror image about the line of sight than to the
  /// truth.
  void flips() const {
    RandomStream random(o_.seed, "bench.tracking.flips");
    int flipped = 0, posed = 0;
    double worst_deg = 0;
    const int views = count(400);
    for (int i = 0; i < views; ++i) {
      const double distance = random.uniform(0.3, 1.5);
      const Pose X = scene_.anyView(random, distance, 70 * kDegree);
      BoardTracker tracker(scene_.board(), scene_.camera(), {{}, false});
      const auto pose = tracker.see(scene_.still(X, static_cast<std::uint64_t>(i)), 0);
      if (!pose) continue;
      ++posed;
      const Vec3 sight = X.translation().normalized(), normal = X.linear().col(2),
                 mirrored = 2 * normal.dot(sight) * sight - normal;
      const Vec3 found = pose->X_CW.linear().col(2);
      flipped += (found - mirrored).norm() < (found - normal).norm();
      worst_deg = std::max(worst_deg, std::acos(std::min(found.dot(normal), 1.0)) / kDegree);
    }
    const json p = params(
        {{"distance_m", "0.3 to 1.5"}, {"tilt_deg", "0 to 70"}, {"views", views}, {"seen", posed}});
    print("flip_rate", static_cast<double>(flipped) / std::max(posed, 1), "1", p);
    print("worst_normal_error", worst_deg, "deg", p);
  }

  TrackingBenchOptions o_;
  TrackingScene scene_;
};

}  // namespace

void benchTracking(const TrackingBenchOptions& options) { TrackingBench(options).run(); }

}  // namespace palpa::bench
