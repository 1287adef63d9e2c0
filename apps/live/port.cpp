#include "apps/live/port.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "apps/live/jpeg.h"
#include "apps/os/local_socket.h"
#include "apps/runtime/clock.h"

namespace palpa::live {
namespace {

constexpr std::size_t kMostPeers = 8, kEntriesAtOnce = 256, kEnoughWaiting = 64 << 10;
constexpr int kCallersAtOnce = 16, kReadsAtOnce = 16;  // of one peer: another's turn comes, and the
                                                       // session's end, whatever one sends
constexpr int kLook_ms = 25, kQuality = 80, kWidest = 1280;
constexpr std::chrono::milliseconds kFarewell{500};

}  // namespace

struct Port::Peer {
  explicit Peer(int descriptor) : socket(descriptor) {}
  ~Peer() { ::close(socket); }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  const int socket;
  FrameDecoder decoder;
  std::string waiting;   ///< to be written
  std::size_t told = 0;  ///< entries of the log
  bool watches = false, lost = false;
  runtime::ServingClock::time_point took =
      runtime::ServingClock::now();  ///< when it took something off, or nothing waited
};

Port::Port(std::string path, const LiveLog& log, Heard heard, std::chrono::milliseconds patience)
    : path_(std::move(path)),
      log_(log),
      heard_(std::move(heard)),
      patience_(patience),
      listener_(os::listenAt(path_)) {
  thread_ = std::thread([this] { run(); });
}

Port::~Port() {
  ending_.store(true);
  thread_.join();
  ::close(listener_);
  ::unlink(path_.c_str());
}

void Port::offer(scene::Image picture) {
  if (picture.channels != 3 || picture.width <= 0 || picture.height <= 0 ||
      picture.pixels.size() !=
          3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height))
    return;
  const std::lock_guard lock(picture_mutex_);
  picture_ = std::move(picture);
  has_picture_.store(true, std::memory_order_release);
}

void Port::run() {
  os::giveWay();
  runtime::ServingClock::time_point leave{};
  for (;;) {
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
    if (allTold() || now > leave) return;
  }
}

void Port::waitForPeers(int timeout_ms) {
  std::vector<pollfd> all{{listener_, POLLIN, 0}};
  for (const auto& peer : peers_)
    all.push_back(
        {peer->socket, static_cast<short>(peer->waiting.empty() ? POLLIN : POLLIN | POLLOUT), 0});
  ::poll(all.data(), all.size(), timeout_ms);
}

void Port::accept() {
  for (int callers = 0, socket;
       callers < kCallersAtOnce &&
       (socket = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK)) >= 0;
       ++callers) {
    if (peers_.size() >= kMostPeers || !os::sameUser(socket)) {
      ::close(socket);
    } else {
      peers_.push_back(std::make_unique<Peer>(socket));
      peers_.back()->waiting = encoded(FrameKind::known, std::to_string(log_.size()));
    }
  }
}

void Port::read(Peer& peer) {
  char bytes[4096];
  ssize_t count = 0;
  for (int reads = 0; (count = ::recv(peer.socket, bytes, sizeof bytes, 0)) > 0;) {
    peer.decoder.feed(bytes, static_cast<std::size_t>(count));
    obey(peer);
    if (peer.lost || ++reads == kReadsAtOnce) return;
  }
  if (count == 0 || (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR)) peer.lost = true;
}

void Port::obey(Peer& peer) {
  try {
    while (const auto frame = peer.decoder.next()) {
      if (frame->kind == FrameKind::watch) peer.watches = frame->body == "1";
      if (frame->kind == FrameKind::command) heard_(frame->body);
    }
  } catch (const Error&) {
    peer.lost = true;  // it does not speak our language
  }
}

void Port::tell(Peer& peer) {
  if (peer.waiting.size() >= kEnoughWaiting) return;
  for (const std::string& entry : log_.since(peer.told, kEntriesAtOnce)) {
    peer.waiting += encoded(FrameKind::entry, entry);
    ++peer.told;
    if (peer.waiting.size() >= kEnoughWaiting) return;
  }
}

void Port::write(Peer& peer) {
  tell(peer);
  const auto now = runtime::ServingClock::now();
  while (!peer.waiting.empty()) {
    const ssize_t count =
        ::send(peer.socket, peer.waiting.data(), peer.waiting.size(), MSG_NOSIGNAL);
    if (count <= 0) {
      peer.lost |= (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) ||
                   now - peer.took > patience_;
      return;
    }
    peer.waiting.erase(0, static_cast<std::size_t>(count));
    peer.took = now;
  }
  peer.took = now;
}

void Port::encodePicture() {
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

void Port::leaveLost() {
  peers_.erase(
      std::remove_if(peers_.begin(), peers_.end(), [](const auto& peer) { return peer->lost; }),
      peers_.end());
}

bool Port::allTold() const {
  return std::all_of(peers_.begin(), peers_.end(), [this](const auto& peer) {
    return peer->waiting.empty() && peer->told == log_.size();
  });
}

}  // namespace palpa::live
