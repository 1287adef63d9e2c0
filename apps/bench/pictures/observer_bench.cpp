#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "anatomy/base/quantile.h"
#include "anatomy/base/random.h"
#include "anatomy/base/units.h"
#include "apps/bench/bench.h"
#include "apps/bench/bench_patients.h"
#include "apps/bench/pictures/observer.h"
#include "apps/bench/pictures/session_frames.h"
#include "apps/bench/pictures/tool_outline.h"
#include "apps/bench/timing.h"
#include "scene/actors/instrument.h"
#include "scene/actors/tool_shadow.h"
#include "scene/view/scene_view.h"

namespace palpa::bench {
namespace {

constexpr int kWidth = 1280, kHeight = 720;
constexpr double kFocal_px = 1100;
constexpr double kHeightBound = 0.003, kDepthBound = 0.005;  // m
constexpr double kLeastFromSight = 30 * kDegree;
constexpr double kHighest = 0.040, kDeepest = 0.050;  // m

/// One pose, how it is looked at, and what is true of it.
struct Shown {
  Pose X_CA = Pose::Identity(), X_AT = Pose::Identity();
  double height = 0, depth = 0;  ///< m, straight above the skin; behind it, along the needle
};

/// Needles about where the subclavian vein is punctured, seen from the trainee's side.
class Poses {
 public:
  explicit Poses(const anatomy::Patient& patient)
      : entry_A_(patient.landmark(anatomy::landmark::kEntry)),
        vein_A_(patient.landmark(anatomy::landmark::kVeinTarget)),
        skin_(patient) {}

  /// Before the puncture, or after it. Others than those that the observer was made with.
  Shown draw(int i, bool inside) const {
    RandomStream random(std::uint64_t(i) + 1,
                        std::string("bench.observer.unseen.") + (inside ? "inside" : "above"));
    for (;;) {
      Vec3 way = (vein_A_ - entry_A_).normalized();
      for (int k = 0; k < 3; ++k) way[k] += 0.15 * random.normal();
      way.normalize();
      const Vec3 high =
          entry_A_ + Vec3(random.uniform(-0.015, 0.015), -0.2, random.uniform(-0.015, 0.015));
      const auto down = skin_.along(high, Vec3::UnitY(), 0.4);
      if (!down) continue;
      const Vec3 on_skin = high + *down * Vec3::UnitY();
      const double aim = inside ? random.uniform(0.003, kDeepest) : random.uniform(0.001, kHighest);
      const Vec3 tip = inside ? Vec3(on_skin + aim * way) : Vec3(on_skin - aim * Vec3::UnitY());
      const auto entry = skin_.along(tip - needle_ * way, way, needle_);
      if (entry.has_value() != inside) continue;
      Shown shown;
      shown.height = inside ? 0 : aim;
      shown.depth = inside ? needle_ - *entry : 0;
      shown.X_AT = makePose(rotationWithZ(way), tip);
      shown.X_CA = lookFrom(on_skin - 0.05 * way, &random);
      if (isSeenFromTheSide(shown)) return shown;
    }
  }

 private:
  /// Nobody tells anything of a needle along which he looks.
  static bool isSeenFromTheSide(const Shown& shown) {
    const Vec3 sight = (shown.X_CA * shown.X_AT.translation()).normalized();
    return std::abs(sight.dot(shown.X_CA.linear() * shown.X_AT.linear().col(2))) <
           std::cos(kLeastFromSight);
  }

  static Pose lookFrom(const Vec3& looked_at, RandomStream* random) {
    const double up = random->uniform(35, 75) * kDegree, round = random->uniform(-40, 40) * kDegree;
    const Vec3 toward_eye(std::cos(up) * std::sin(round), -std::sin(up),
                          -std::cos(up) * std::cos(round));
    return lookAt(looked_at + random->uniform(0.40, 0.55) * toward_eye, looked_at);
  }

  const double needle_ = scene::InstrumentSize().needle_length;
  Vec3 entry_A_, vein_A_;
  SkinRay skin_;
};

/// One AR view alone.
class Stage {
 public:
  explicit Stage(const anatomy::Patient& patient)
      : context_(scene::makeGlContext(scene::Display::offscreen, kWidth, kHeight, "Palpa")),
        view_(*context_, patient, {kWidth, kHeight, scene::FixedViews::none, false}) {
    state_.registered = true;
    state_.picture = &table_;
    state_.camera = {
        kWidth, kHeight, kFocal_px, kFocal_px, 0.5 * (kWidth - 1), 0.5 * (kHeight - 1)};
    state_.look = SessionFrames::usualLook();
  }

  cv::Mat picture(const Shown& shown, bool with_tool, bool shadows) {
    state_.X_CA = shown.X_CA;
    state_.X_AT = shown.X_AT;
    state_.show_tool = with_tool;
    state_.shadows = shadows;
    view_.show(state_);
    scene::Image image = view_.capture();
    return cv::Mat(kHeight, kWidth, CV_8UC3, image.pixels.data()).clone();
  }
  const scene::Pinhole& camera() const { return state_.camera; }

 private:
  std::unique_ptr<scene::GlContextProvider> context_;
  scene::SceneView view_;
  scene::Image table_{kWidth, kHeight, 3,
                      std::vector<std::uint8_t>(std::size_t{3} * kWidth * kHeight, 110)};
  scene::SceneState state_;
};

Observer::Knows knows(const scene::Pinhole& camera, const Shown& shown) {
  const scene::InstrumentSize size;
  return {camera, shown.X_CA.linear() * -scene::kTowardLight_A, size.needle_length,
          size.barrel_radius};
}

/// m, by whether there are shadow and ring; of what is not seen, as far as the farthest.
std::map<bool, std::vector<double>> errorsOf(const Poses& poses, Stage* stage, int count,
                                             bool inside) {
  std::map<bool, std::vector<double>> errors;
  for (int i = 0; i < count; ++i) {
    const Shown shown = poses.draw(i, inside);
    const Observer observer(knows(stage->camera(), shown));
    const cv::Mat3b before = stage->picture(shown, false, false);
    for (const bool shadows : {true, false}) {
      const cv::Mat3b now = stage->picture(shown, true, shadows);
      const auto said =
          inside ? observer.depthBehindSkin(before, now) : observer.heightAboveSkin(before, now);
      const double truth = inside ? shown.depth : shown.height;
      errors[shadows].push_back(said ? std::abs(*said - truth) : kDeepest);
    }
    if (i % 50 == 49)
      std::fprintf(stderr, "%s: %d of %d poses\n", inside ? "inside" : "above", i + 1, count);
  }
  return errors;
}

}  // namespace

void benchObserver(const ObserverBenchOptions& options) {
  const anatomy::Patient patient = referenceBust();
  const Poses poses(patient);
  Stage stage(patient);
  for (const bool inside : {false, true})
    for (const auto& [shadows, errors] : errorsOf(poses, &stage, options.poses, inside)) {
      const double bound = inside ? kDepthBound : kHeightBound;
      const auto within =
          std::count_if(errors.begin(), errors.end(), [&](double e) { return e <= bound; });
      const nlohmann::json params{{"poses", options.poses},
                                  {"shadow_and_ring", shadows},
                                  {"within_mm", 1e3 * bound},
                                  {"data", "simulated"}};
      const std::string what = inside ? "depth" : "height";
      print(what + "_told", double(within) / options.poses, "1", params);
      print(what + "_error_p95", 1e3 * quantile(errors, 0.95), "mm", params);
    }
}

}  // namespace palpa::bench
