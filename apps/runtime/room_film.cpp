#include "apps/runtime/room_film.h"

#include <optional>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "apps/runtime/camera_activity.h"

namespace palpa::runtime {
namespace {

constexpr std::int64_t kPicture = 125 * kMillisecond, kAskCamera = kSecond;
constexpr int kWidest = 640, kFilmQuality = 70;

}  // namespace

RoomFilm::RoomFilm(Open open, bool waits, const std::filesystem::path& folder, const Clock& clock)
    : open_(std::move(open)), waits_(waits), clock_(clock), file_(folder, "room", "offset") {}

std::int64_t RoomFilm::step(std::int64_t now_ns) {
  try {
    if (!camera_) camera_ = open_();
    const std::optional<ar::Frame> frame = camera_->grab();
    if (!frame) return kNever;
    keep(*frame, waits_ ? exposureOf(*frame, 0, clock_) : now_ns);
  } catch (const std::exception& e) {
    const std::string what = e.what();
    camera_trouble_ = what.substr(0, what.find('\n'));
    camera_.reset();
    return now_ns + kAskCamera;
  }
  if (!file_.trouble().empty()) return kNever;
  return waits_ ? now_ns + kMillisecond : now_ns + kPicture;
}

void RoomFilm::keep(const ar::Frame& frame, std::int64_t t_ns) {
  if (kept_ns_ >= 0 && t_ns < kept_ns_ + kPicture) return;
  kept_ns_ = t_ns;
  cv::Mat small = frame.image;
  if (small.cols > kWidest)
    cv::resize(frame.image, small, {kWidest, small.rows * kWidest / small.cols}, 0, 0,
               cv::INTER_AREA);
  file_.add(small, t_ns, kFilmQuality, std::to_string(file_.bytes()));
}

}  // namespace palpa::runtime
