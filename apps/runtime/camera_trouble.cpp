#include "apps/runtime/camera_trouble.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace palpa::runtime {
namespace {

constexpr std::int64_t kSilent =
    1'500'000'000;  // without a picture, though the source has not said that it failed

}  // namespace

std::string cameraTrouble(const CameraView* view, std::int64_t now_ns) {
  if (!view) return "no picture from the camera yet";
  switch (view->fault) {
    case ar::PictureFault::black:
      return "the camera's picture is black: is the lens covered?";
    case ar::PictureFault::frozen:
      return "the camera's picture stands still: look at its cable";
    case ar::PictureFault::wrong_size:
      return "the camera's pictures are of another size than it was calibrated for";
    case ar::PictureFault::gone:
      return "the camera is gone: " + (view->source.empty() ? "look at its cable" : view->source);
    case ar::PictureFault::ended:
      return "the camera's pictures have ended";
    case ar::PictureFault::none:
      break;
  }
  if (now_ns - view->t_exposure_ns > kSilent)
    return "the camera gives no pictures: look at its cable";
  switch (view->tracking) {
    case ar::TrackState::searching:
      return view->by_tracker ? "the tracking system says nothing of the camera yet: is its server "
                                "running, are both markers in its sight?"
                              : "the camera does not see the board";
    case ar::TrackState::lost:
      return view->by_tracker ? "the tracking system has lost the camera or the table, or sends "
                                "nothing any more: the overlay stands still"
                              : "the camera has lost the board: the overlay stands still";
    case ar::TrackState::tracked:
    case ar::TrackState::coasting:
      break;
  }
  return "";
}

namespace {

constexpr double kEdge = 0.1;  // m
constexpr double kBack = 0.7;

}  // namespace

std::optional<Displaced> displacedBoard(const CameraView& view,
                                        const std::vector<BoardPlace>& places,
                                        std::optional<std::size_t> was) {
  if (!view.X_CW) return std::nullopt;
  for (std::size_t i = 0; i < std::min(places.size(), view.others.size()); ++i) {
    const BoardPlace& place = places[i];
    if (!place.X_WB || !view.others[i]) continue;
    const Pose off = place.X_WB->inverse() * view.X_CW->inverse() * *view.others[i];
    const double moved = off.translation().norm(), turned = Eigen::AngleAxisd(off.linear()).angle();
    const double most = was == i ? kBack * place.tolerance : place.tolerance;
    if (moved <= most && turned * kEdge <= most) continue;
    char words[160];
    if (moved > most)
      std::snprintf(words, sizeof words, " has moved by %.0f mm: put it back, or calibrate again",
                    1e3 * moved);
    else
      std::snprintf(words, sizeof words,
                    " is turned by %.1f degrees: turn it back, or calibrate again",
                    turned * 57.29578);
    return Displaced{i, "the " + place.name + words};
  }
  return std::nullopt;
}

}  // namespace palpa::runtime
