#include "apps/live/port.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "apps/live/wire.h"
#include "apps/os/real_time.h"
#include "apps/os/socket.h"
#include "apps/runtime/clock.h"
#include "ar/codecs/codecs.h"

namespace palpa::live {
namespace {

constexpr std::size_t kMostPeers = 8, kEntriesAtOnce = 256, kEnoughWaiting = 64 << 10;
// Of one peer: another's turn comes, and the session's end, whatever one sends
constexpr int kCallersAtOnce = 16, kReadsAtOnce = 16;
constexpr int kLook_ms = 25, kQuality = 80, kWidest = 1280;
constexpr std::chrono::milliseconds kFarewell{500};

}  // namespace

/// What the port's thread works with. It may outlive the port, where it hangs; then without what is
/// the port's owner's.
class Port::Line {
 public:
  Line(int listener, const LiveLog& log, Received received, std::chrono::milliseconds patience)
      : patience_(patience),
        listener_(os::sharedSocket(listener)),
        log_(&log),
        received_(std::move(received)) {
    if (listener_ < 0)
      throw Error("has no descriptor left", "this process", "Raise the limit (ulimit -n)");
  }
  ~Line() { os::closeSocket(listener_); }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  void run();

  // Any thread.
  void askToEnd() { ending_.store(true); }
  void leaveOwner();
  bool silentFor(std::chrono::nanoseconds time) const;
  bool wantsPicture() const {
    return watched_.load(std::memory_order_relaxed) &&
           !has_picture_.load(std::memory_order_acquire);
  }
  void offer(scene::Image picture);

 private:
  struct Peer;
  void waitForPeers(int timeout_ms);
  void accept();
  void read(Peer& peer);
  void apply(Peer& peer);
  void write(Peer& peer);
  void sendTo(Peer& peer);
  void encodePicture();
  void leaveLost();
  bool allSent();
  std::size_t logSize();
  std::vector<std::string> logSince(std::size_t from);
  void receive(const std::string& command);

  const std::chrono::milliseconds patience_;
  const int listener_;
  std::vector<std::unique_ptr<Peer>> peers_;
  std::atomic<runtime::ServingClock::time_point> came_round_ = runtime::ServingClock::now();
  std::atomic<bool> watched_{false}, has_picture_{false}, ending_{false};
  std::mutex picture_mutex_;
  scene::Image picture_;
  std::mutex owner_mutex_;
  const LiveLog* log_;  ///< null: the owner is gone
  Received received_;
};

struct Port::Line::Peer {
  explicit Peer(int descriptor) : socket(descriptor) {}
  ~Peer() { os::closeSocket(socket); }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  const int socket;
  FrameDecoder decoder;
  std::string waiting;   ///< to be written
  std::size_t sent = 0;  ///< entries of the log
  bool watches = false, lost = false;
  runtime::ServingClock::time_point took =
      runtime::ServingClock::now();  ///< when it took something off, or nothing waited
};

Port::Port(const std::string& path, const LiveLog& log, Received received,
           std::chrono::milliseconds patience)
    : listener_(path, "Give a folder that can be written to, or leave out --live"),
      line_(std::make_shared<Line>(listener_.socket(), log, std::move(received), patience)) {
  ar::loadCodecs();
  const auto over = std::make_shared<std::promise<void>>();
  over_ = over->get_future();
  thread_ = os::startThread([line = line_, over] {
    line->run();
    over->set_value();
  });
}

Port::~Port() { end(); }

bool Port::end() {
  if (!thread_.joinable()) return true;
  line_->askToEnd();
  const bool over = over_.wait_for(kFarewell + kLineHangs) == std::future_status::ready;
  if (over) {
    thread_.join();
  } else {
    line_->leaveOwner();
    thread_.detach();
  }
  return over;
}

bool Port::silentFor(std::chrono::nanoseconds time) const { return line_->silentFor(time); }

bool Port::wantsPicture() const { return line_->wantsPicture(); }

void Port::offer(scene::Image picture) { line_->offer(std::move(picture)); }

void Port::Line::leaveOwner() {
  const std::lock_guard lock(owner_mutex_);
  log_ = nullptr;
  received_ = nullptr;
}

std::size_t Port::Line::logSize() {
  const std::lock_guard lock(owner_mutex_);
  return log_ ? log_->size() : 0;
}

std::vector<std::string> Port::Line::logSince(std::size_t from) {
  const std::lock_guard lock(owner_mutex_);
  return log_ ? log_->since(from, kEntriesAtOnce) : std::vector<std::string>{};
}

void Port::Line::receive(const std::string& command) {
  const std::lock_guard lock(owner_mutex_);
  if (received_) received_(command);
}

bool Port::Line::silentFor(std::chrono::nanoseconds time) const {
  return runtime::ServingClock::now() - came_round_.load() >= time;
}

void Port::Line::offer(scene::Image picture) {
  if (picture.channels != 3 || picture.width <= 0 || picture.height <= 0 ||
      picture.pixels.size() !=
          3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height))
    return;
  const std::lock_guard lock(picture_mutex_);
  picture_ = std::move(picture);
  has_picture_.store(true, std::memory_order_release);
}

void Port::Line::run() {
  os::giveWay();
  runtime::ServingClock::time_point leave{};
  for (;;) {
    came_round_.store(runtime::ServingClock::now());
    waitForPeers(kLook_ms);
    accept();
    encodePicture();
    for (auto& peer : peers_) {
      read(*peer);
      write(*peer);
    }
    leaveLost();
    if (!ending_.load()) continue;
    const auto now = runtime::ServingClock::now();
    if (leave == runtime::ServingClock::time_point{}) leave = now + kFarewell;
    if (allSent() || now > leave) break;
  }
  peers_.clear();
}

void Port::Line::waitForPeers(int timeout_ms) {
  std::vector<os::WatchedSocket> all{os::WatchedSocket{listener_}};
  for (const auto& peer : peers_) all.push_back({peer->socket, !peer->waiting.empty()});
  os::waitForAny(all, timeout_ms);
}

void Port::Line::accept() {
  for (int callers = 0, socket;
       callers < kCallersAtOnce && (socket = os::acceptOne(listener_)) >= 0; ++callers) {
    if (peers_.size() >= kMostPeers || !os::sameUser(socket)) {
      os::closeSocket(socket);
    } else {
      peers_.push_back(std::make_unique<Peer>(socket));
      peers_.back()->waiting = encoded(FrameKind::known, std::to_string(logSize()));
    }
  }
}

void Port::Line::read(Peer& peer) {
  char bytes[4096];
  for (int reads = 0; reads < kReadsAtOnce && !peer.lost; ++reads) {
    const std::optional<std::size_t> count = os::receiveSome(peer.socket, bytes, sizeof bytes);
    peer.lost = !count;
    if (count.value_or(0) == 0) return;
    peer.decoder.feed(bytes, *count);
    apply(peer);
  }
}

void Port::Line::apply(Peer& peer) {
  try {
    while (const auto frame = peer.decoder.next()) {
      if (frame->kind == FrameKind::watch) peer.watches = frame->body == "1";
      if (frame->kind == FrameKind::command) receive(frame->body);
    }
  } catch (const Error&) {
    peer.lost = true;  // it does not speak our language
  }
}

void Port::Line::sendTo(Peer& peer) {
  if (peer.waiting.size() >= kEnoughWaiting) return;
  for (const std::string& entry : logSince(peer.sent)) {
    peer.waiting += encoded(FrameKind::entry, entry);
    ++peer.sent;
    if (peer.waiting.size() >= kEnoughWaiting) return;
  }
}

void Port::Line::write(Peer& peer) {
  sendTo(peer);
  const auto now = runtime::ServingClock::now();
  while (!peer.waiting.empty()) {
    const std::optional<std::size_t> count =
        os::sendSome(peer.socket, peer.waiting.data(), peer.waiting.size());
    if (count.value_or(0) == 0) {
      peer.lost |= !count || now - peer.took > patience_;
      return;
    }
    peer.waiting.erase(0, *count);
    peer.took = now;
  }
  peer.took = now;
}

void Port::Line::encodePicture() {
  watched_.store(
      std::any_of(peers_.begin(), peers_.end(), [](const auto& peer) { return peer->watches; }),
      std::memory_order_relaxed);
  if (!has_picture_.load(std::memory_order_acquire)) return;
  scene::Image picture;
  {
    const std::lock_guard lock(picture_mutex_);
    picture = std::move(picture_);
    has_picture_.store(false, std::memory_order_release);
  }
  const std::string frame = encoded(FrameKind::picture, jpegOf(picture, kQuality, kWidest));
  for (auto& peer : peers_)
    if (peer->watches && peer->waiting.size() < kEnoughWaiting) peer->waiting += frame;
}

void Port::Line::leaveLost() {
  peers_.erase(
      std::remove_if(peers_.begin(), peers_.end(), [](const auto& peer) { return peer->lost; }),
      peers_.end());
}

bool Port::Line::allSent() {
  const std::size_t all = logSize();
  return std::all_of(peers_.begin(), peers_.end(), [all](const auto& peer) {
    return peer->waiting.empty() && peer->sent >= all;
  });
}

std::string jpegOf(const scene::Image& image, int quality, int widest) {
  const cv::Mat shown(image.height, image.width, CV_8UC3,
                      const_cast<std::uint8_t*>(image.pixels.data()));
  cv::Mat bgr;
  cv::cvtColor(shown, bgr, cv::COLOR_RGB2BGR);
  if (widest > 0 && bgr.cols > widest)
    cv::resize(bgr, bgr, {widest, bgr.rows * widest / bgr.cols}, 0, 0, cv::INTER_AREA);
  const std::vector<std::uint8_t> bytes =
      ar::encode(".jpg", bgr, {cv::IMWRITE_JPEG_QUALITY, quality});
  return {bytes.begin(), bytes.end()};
}

}  // namespace palpa::live
