#include <cmath>
#include <map>

#include "anatomy/base/error.h"
#include "apps/calibrate/collect.h"

namespace palpa::calibrate {
namespace {

using runtime::BoardFraming;
using runtime::Request;
constexpr double kStill_px = 0.6;        // mean motion of the corners between two pictures
constexpr double kPatienceForView = 30;  // s
constexpr std::size_t kLeastCorners = 16;
constexpr double kLean = 0.5;  // rad

std::string wordsFor(const BoardFraming& v) {
  const std::string where = std::string(v.down < -0.2  ? "upper "
                                        : v.down > 0.2 ? "lower "
                                                       : "") +
                            (v.across < -0.2  ? "left"
                             : v.across > 0.2 ? "right"
                                              : "middle");
  std::string how;
  if (v.lean > 0.2) how = ", its upper edge tilted toward the camera";
  if (v.lean < -0.2) how = ", its lower edge tilted toward the camera";
  if (v.turn > 0.2) how += ", its left edge turned toward the camera";
  if (v.turn < -0.2) how += ", its right edge turned toward the camera";
  return "Hold the board still in the " + where + " of the picture" + how +
         (v.share > 0.6    ? ", near"
          : v.share < 0.45 ? ", far"
                           : "");
}

/// Every part of the picture, leaning every way, near and far.
BoardFraming planned(int i) {
  static constexpr double kAcross[] = {0, -0.5, 0.5, -0.5, 0.5, 0, -0.55, 0.55, 0};
  static constexpr double kDown[] = {0, -0.45, 0.45, 0.45, -0.45, -0.5, 0, 0, 0.5};
  static constexpr double kLeans[] = {1, -1, 0, 0, 0.8, -0.8};
  static constexpr double kTurns[] = {0, 0, 1, -1, 0.8, -0.8, 0.8};
  static constexpr double kShares[] = {0.62, 0.5, 0.4, 0.55};
  const auto at = [i](const auto& list) {
    return list[static_cast<std::size_t>(i) % std::size(list)];
  };
  return {at(kAcross), at(kDown), kLean * at(kLeans), kLean * at(kTurns), at(kShares)};
}

double movedSince(const std::vector<ar::BoardPoint>& before,
                  const std::vector<ar::BoardPoint>& now) {
  std::map<std::pair<double, double>, Eigen::Vector2d> places;
  for (const ar::BoardPoint& point : before) places[{point.p_W.x(), point.p_W.y()}] = point.pixel;
  double sum = 0;
  int n = 0;
  for (const ar::BoardPoint& point : now) {
    const auto found = places.find({point.p_W.x(), point.p_W.y()});
    if (found == places.end()) continue;
    sum += (found->second - point.pixel).norm();
    ++n;
  }
  return n ? sum / n : 1e9;
}

/// The next picture in which the board is seen well and stands still.
std::vector<ar::BoardPoint> stillView(const Scene& scene, const ar::Board& board) {
  std::vector<ar::BoardPoint> before;
  for (double begun = -1;;) {
    const std::optional<runtime::RigMoment> moment = scene.rig.next();
    if (!moment) throw Error("the pictures ended", "calibration of the camera", "Begin again");
    if (begun < 0) begun = moment->t;
    if (moment->t - begun > kPatienceForView) return {};
    if (!moment->picture || moment->t - begun < 0.3) continue;
    const std::optional<ar::Frame> frame = moment->picture();
    if (!frame) continue;
    std::vector<ar::BoardPoint> points = board.detect(frame->image);
    if (points.size() >= kLeastCorners && movedSince(before, points) < kStill_px) return points;
    before = std::move(points);
  }
}

}  // namespace

std::vector<calibration::BoardView> collectViews(const Scene& scene, int views) {
  const std::unique_ptr<ar::Board> board =
      ar::makeBoard(scene.station.board, scene.station.decimate);
  std::vector<calibration::BoardView> taken;
  calibration::CoverageMap coverage{};
  for (int i = 0; i < views; ++i) {
    Request request;
    request.what = Request::What::show_board;
    request.view = planned(i);
    request.words = wordsFor(request.view);
    scene.guide.ask(request.words);
    scene.rig.ask(request);
    const std::vector<ar::BoardPoint> points = stillView(scene, *board);
    if (points.empty()) continue;  // not seen there: another view may serve
    calibration::BoardView view;
    view.name = "view " + std::to_string(i + 1);
    for (const ar::BoardPoint& point : points) {
      view.p_W.push_back(point.p_W);
      view.pixels.push_back(point.pixel);
    }
    taken.push_back(std::move(view));
    for (const ar::BoardPoint& point : points)
      if (int* cell = calibration::cellAt(coverage, point.pixel, scene.station.camera.width,
                                          scene.station.camera.height))
        ++*cell;
    scene.guide.covered(points, coverage);
    scene.guide.progress(
        "Views of the board", i + 1, views,
        std::to_string(points.size()) + " corners; " +
            std::to_string(std::lround(100 * calibration::coveredShare(coverage))) +
            " % of the picture covered so far");
  }
  return taken;
}

}  // namespace palpa::calibrate
