#include "calibration/camera_calibration.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "anatomy/base/error.h"
#include "calibration/rotation.h"

namespace palpa::calibration {
namespace {

const char kCamera[] = "camera calibration";
constexpr std::size_t kLeastViews = 4;
constexpr double kLeastTilt = 5 * kDegree, kWorstCamera = 0.02, kMostWrong = 0.3,
                 kBadView = 1 / 3.0, kLeastCovered = 0.5;
constexpr int kRounds = 4;
constexpr int kLenses[] = {kLensNumbers, 8, 5};  // all; without k3; with k1 only

double tiltSpread(const std::vector<Pose>& X_CW) {
  Vec3 mean = Vec3::Zero();
  for (const Pose& X : X_CW) mean += X.linear().col(2);
  double squares = 0;
  for (const Pose& X : X_CW)
    squares +=
        std::pow(std::acos(std::clamp(X.linear().col(2).dot(mean.normalized()), -1.0, 1.0)), 2);
  return std::sqrt(squares / static_cast<double>(X_CW.size()));
}

void requireTilts(double spread) {
  if (spread >= kLeastTilt) return;
  char words[160];
  std::snprintf(words, sizeof words,
                "all views show the board from the same side (%.1f degrees rms apart): the focal "
                "length cannot be told from the distance",
                spread / kDegree);
  throw Error(words, kCamera, "Tilt the board to every side by 30 degrees");
}

/// Rms distance of the corners for which `counts(i)`; 0 when there is none.
template <class Counts>
double rmsIn(const BoardView& view, const CameraModel& model, const Pose& X_CW, Counts counts) {
  double squares = 0, n = 0;
  for (std::size_t i = 0; i < view.pixels.size(); ++i) {
    if (!counts(i)) continue;
    squares += (model.project(X_CW * view.p_W[i]) - view.pixels[i]).squaredNorm();
    ++n;
  }
  return n > 0 ? std::sqrt(squares / n) : 0;
}

class CameraEstimate {
 public:
  CameraEstimate(const std::vector<BoardView>& views, const CameraBundle& start, int lens_numbers,
                 bool keep_all)
      : views_(views), lens_(lens_numbers), keep_all_(keep_all) {
    result_.model = start.model;
    result_.determined = lens_numbers;
    for (std::size_t v = 0; v < views.size(); ++v) {
      result_.views.push_back({});
      result_.views[v].name = views[v].name;
      result_.views[v].X_CW = start.X_CW[v];
    }
  }

  CameraCalibration run() {
    for (int round = 0; round < kRounds; ++round) {
      adjust();
      requireGoodCorners();
      if (!leaveOutBadViews()) break;
    }
    describeViews();
    describeLens();
    return result_;
  }

 private:
  template <class Do>
  void forUsed(Do act) const {
    for (std::size_t v = 0; v < views_.size(); ++v)
      if (result_.views[v].used) act(v);
  }

  void adjust() {
    std::vector<BoardView> used;
    CameraBundle bundle{result_.model, {}};
    forUsed([&](std::size_t v) {
      used.push_back(views_[v]);
      bundle.X_CW.push_back(result_.views[v].X_CW);
    });
    if (used.size() < kLeastViews)
      throw Error(
          "fewer than " + std::to_string(kLeastViews) + " views fit each other", kCamera,
          "See that all are of the same camera, zoom, focus and board, and take them again");
    result_.fit = adjustBundle(used, lens_, keep_all_, &bundle, kCamera);
    result_.model = bundle.model;
    std::size_t at = 0, corner = 0;
    good_.assign(views_.size(), {});
    forUsed([&](std::size_t v) {
      result_.views[v].X_CW = bundle.X_CW[at++];
      for (std::size_t i = 0; i < views_[v].pixels.size(); ++i)
        good_[v].push_back(result_.fit.good[corner++]);
      result_.views[v].outliers =
          static_cast<int>(std::count(good_[v].begin(), good_[v].end(), false));
    });
  }

  /// Of the given views, left-out ones too: all their corners are wrong.
  void requireGoodCorners() const {
    double corners = 0, good = 0;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      corners += static_cast<double>(views_[v].pixels.size());
      good += static_cast<double>(std::count(good_[v].begin(), good_[v].end(), true));
    }
    if (good >= (1 - kMostWrong) * corners) return;
    char words[120];
    std::snprintf(words, sizeof words, "%.0f %% of the corners do not fit the others",
                  100 * (1 - good / corners));
    throw Error(words, kCamera,
                "See that the board is flat, the pictures sharp, and all of the same camera, zoom, "
                "focus and board");
  }

  /// Whether there were any.
  bool leaveOutBadViews() {
    bool any = false;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      ViewResult& view = result_.views[v];
      if (!view.used || view.outliers <= kBadView * static_cast<double>(views_[v].pixels.size()))
        continue;
      view.used = false;
      any = true;
    }
    return any;
  }

  void describeViews() {
    double squares = 0, corners = 0;
    std::vector<Pose> used;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      ViewResult& view = result_.views[v];
      view.tilt = std::acos(std::min(std::abs(view.X_CW.linear()(2, 2)), 1.0));
      view.rms_px = rmsIn(views_[v], result_.model, view.X_CW,
                          [&](std::size_t i) { return !view.used || good_[v][i]; });
      if (!view.used) continue;
      used.push_back(view.X_CW);
      const double all =
                       rmsIn(views_[v], result_.model, view.X_CW, [](std::size_t) { return true; }),
                   n = static_cast<double>(views_[v].pixels.size());
      squares += n * all * all;
      corners += n;
    }
    result_.rms_all_px = std::sqrt(squares / corners);
    result_.model.rms_px = result_.fit.rms;
    result_.tilt_spread = tiltSpread(used);
    countCoverage();
  }

  void countCoverage() {
    forUsed([&](std::size_t v) {
      for (std::size_t i = 0; i < views_[v].pixels.size(); ++i)
        if (int* cell = cellAt(result_.coverage, views_[v].pixels[i], result_.model.width,
                               result_.model.height);
            cell && good_[v][i])
          ++*cell;
    });
    result_.covered = coveredShare(result_.coverage);
  }

  void describeLens() {
    result_.covariance.topLeftCorner(lens_, lens_) =
        result_.fit.covariance.topLeftCorner(lens_, lens_);
    for (int k = 0; k < lens_; ++k) {
      result_.sd[static_cast<std::size_t>(k)] = std::sqrt(result_.fit.covariance(k, k));
      result_.half95[static_cast<std::size_t>(k)] = result_.fit.halfWidth95(k);
    }
  }

  const std::vector<BoardView>& views_;
  int lens_;
  bool keep_all_;
  CameraCalibration result_;
  std::vector<std::vector<bool>> good_;  // by view and corner; empty for views left out
};

bool couldBeACamera(const CameraModel& model) {
  try {
    validate(model, kCamera);
    return true;
  } catch (const Error&) {
    return false;
  }
}

void requireKnown(const CameraCalibration& found) {
  const double focal = std::min(found.model.fx, found.model.fy),
               worst = *std::max_element(found.sd.begin(), found.sd.begin() + 4);
  if (worst < kWorstCamera * focal) return;
  char words[120];
  std::snprintf(words, sizeof words,
                "focal length and centre would be known to %.0f px only (one standard deviation)",
                worst);
  throw Error(words, kCamera, "Take more views, nearer and more tilted");
}

std::vector<std::string> warningsOf(const CameraCalibration& found) {
  std::vector<std::string> warnings;
  for (const std::string& name : found.leftOut())
    warnings.push_back("the view " + name + " does not fit the others and was left out");
  char words[200];
  if (found.covered < kLeastCovered) {
    std::snprintf(words, sizeof words,
                  "corners were seen in %.0f %% of the picture only: where there was none, the "
                  "lens's distortion is a guess; take views that reach into the corners",
                  100 * found.covered);
    warnings.push_back(words);
  }
  if (found.determined < kLensNumbers) {
    std::snprintf(
        words, sizeof words,
        "the corners do not reach far enough out to tell all of the distortion: %s held at 0",
        found.determined == 8 ? "k3 was" : "k2, p1, p2 and k3 were");
    warnings.push_back(words);
  }
  return warnings;
}

}  // namespace

int* cellAt(CoverageMap& map, const Eigen::Vector2d& pixel, int width, int height) {
  const double x = (pixel.x() + 0.5) / width, y = (pixel.y() + 0.5) / height;
  if (!(x >= 0 && y >= 0 && x < 1 && y < 1)) return nullptr;
  return &map[static_cast<std::size_t>(y * kCoverageRows)]
             [static_cast<std::size_t>(x * kCoverageColumns)];
}

double coveredShare(const CoverageMap& map) {
  double cells = 0;
  for (const auto& row : map)
    cells +=
        static_cast<double>(std::count_if(row.begin(), row.end(), [](int n) { return n > 0; }));
  return cells / (kCoverageRows * kCoverageColumns);
}

std::vector<std::string> CameraCalibration::leftOut() const {
  std::vector<std::string> names;
  for (const ViewResult& view : views)
    if (!view.used) names.push_back(view.name);
  return names;
}

CameraCalibration calibrateCamera(const std::vector<BoardView>& views, int width, int height,
                                  const CameraOptions& options) {
  if (views.size() < kLeastViews)
    throw Error(std::to_string(views.size()) + " views are too few", kCamera,
                "Take ten or more, from every side");
  requireBoardViews(views, kCamera);
  const CameraBundle start = startBundle(views, width, height, kCamera);
  requireTilts(tiltSpread(start.X_CW));
  CameraCalibration result;
  for (const int lens_numbers : kLenses) {
    result = CameraEstimate(views, start, lens_numbers, options.keep_all).run();
    if (couldBeACamera(result.model)) break;
  }
  requireTilts(result.tilt_spread);
  requireKnown(result);
  validate(result.model, kCamera);
  result.warnings = warningsOf(result);
  return result;
}

}  // namespace palpa::calibration
