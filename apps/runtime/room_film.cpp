#include "apps/runtime/room_film.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/left_behind.h"
#include "apps/os/real_time.h"
#include "apps/runtime/camera_activity.h"

namespace palpa::runtime {
namespace {

constexpr std::int64_t kPicture = 125 * kMillisecond, kAskCamera = kSecond,
                       kLook = 20 * kMillisecond;
constexpr auto kPatience = std::chrono::milliseconds(500);  // at the end, with what hangs
constexpr std::size_t kWaiting = 4;                         // pictures that nobody has taken yet
constexpr int kWidest = 640, kFilmQuality = 70;

}  // namespace

/// The camera, with the thread that asks it, if it has one; both own it, so that what hangs in a
/// driver can be left behind.
struct RoomFilm::Asked {
  explicit Asked(Open how) : open(std::move(how)) {}

  /// Throws what the camera throws; it is opened anew then.
  std::optional<ar::Frame> grab() {
    try {
      if (!camera) camera = open();
      return camera->grab();
    } catch (...) {
      camera.reset();
      throw;
    }
  }
  void say(const std::string& words) {
    const std::lock_guard lock(mutex);
    trouble = words;
    told = false;
  }
  /// On its thread: until nobody wants more, or there is no more.
  void run() {
    while (true) {
      std::optional<ar::Frame> frame;
      std::string why;
      try {
        frame = grab();
      } catch (const std::exception& e) {
        why = firstLine(e);
      }
      std::unique_lock lock(mutex);
      if (ending || (!frame && why.empty())) break;
      if (!why.empty()) {
        told = told && trouble == why;
        trouble = why;
        changed.wait_for(lock, std::chrono::nanoseconds(kAskCamera), [this] { return ending; });
        continue;
      }
      changed.wait(lock, [this] { return ending || waiting.size() < kWaiting; });
      if (ending) break;
      waiting.push_back(std::move(*frame));
    }
    camera.reset();
    const std::lock_guard lock(mutex);
    over = true;
    changed.notify_all();
  }

  const Open open;
  std::unique_ptr<ar::Camera> camera;
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<ar::Frame> waiting;
  std::string trouble;
  bool told = true, ending = false, over = false;
};

RoomFilm::RoomFilm(const Open& open, bool waits, const std::filesystem::path& folder,
                   const Clock& clock)
    : asked_(std::make_shared<Asked>(open)),
      waits_(waits),
      clock_(clock),
      file_(folder, "room", "offset") {
  if (!waits_) return;
  os::startThread([asked = asked_] { asked->run(); }).detach();
}

RoomFilm::~RoomFilm() {
  if (!waits_) return;
  std::unique_lock lock(asked_->mutex);
  asked_->ending = true;
  asked_->changed.notify_all();
  const bool over = asked_->changed.wait_for(lock, kPatience, [this] { return asked_->over; });
  lock.unlock();
  if (!over) leaveBehind(asked_);
}

std::int64_t RoomFilm::step(std::int64_t now_ns) {
  if (!file_.trouble().empty()) return kNever;
  if (!waits_) {
    try {
      const std::optional<ar::Frame> frame = asked_->grab();
      if (!frame) return kNever;
      keep(*frame, now_ns);
    } catch (const std::exception& e) {
      asked_->say(firstLine(e));
      return now_ns + kAskCamera;
    }
    return now_ns + kPicture;
  }
  std::deque<ar::Frame> frames;
  bool over = false;
  {
    const std::lock_guard lock(asked_->mutex);
    frames.swap(asked_->waiting);
    over = asked_->over;
    asked_->changed.notify_all();
  }
  for (const ar::Frame& frame : frames) keep(frame, exposureOf(frame, 0, clock_));
  return over ? kNever : now_ns + kLook;
}

void RoomFilm::keep(const ar::Frame& frame, std::int64_t t_ns) {
  if (kept_ns_ >= 0 && t_ns < kept_ns_ + kPicture) return;
  kept_ns_ = t_ns;
  cv::Mat small = frame.image;
  if (small.cols > kWidest)
    cv::resize(frame.image, small, {kWidest, small.rows * kWidest / small.cols}, 0, 0,
               cv::INTER_AREA);
  file_.add(small, t_ns, kFilmQuality, std::to_string(file_.bytes()));
  if (!file_.trouble().empty()) asked_->say(file_.trouble());
}

std::string RoomFilm::trouble() const {
  const std::lock_guard lock(asked_->mutex);
  return asked_->trouble;
}

std::string RoomFilm::news() {
  const std::lock_guard lock(asked_->mutex);
  return std::exchange(asked_->told, true) ? "" : "The room is not filmed: " + asked_->trouble;
}

}  // namespace palpa::runtime
