#include "apps/runtime/camera_words.h"

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

}  // namespace palpa::runtime
