#include "apps/live/stop_port.h"

#include <filesystem>
#include <utility>

#include "apps/live/wire.h"
#include "apps/os/local_socket.h"
#include "apps/runtime/clock.h"

namespace palpa::live {
namespace {

constexpr std::size_t kMostPressers = 8;
constexpr int kForever_ms = -1;
constexpr std::chrono::milliseconds kNoDescriptor{10};

}  // namespace

struct StopPort::Presser {
  explicit Presser(int from) : socket(from) {}
  ~Presser() { os::closeSocket(socket); }
  Presser(const Presser&) = delete;
  Presser& operator=(const Presser&) = delete;

  const int socket;
  FrameDecoder decoder;
};

StopPort::StopPort(std::string path, std::function<void()> pressed)
    : path_(std::move(path)),
      pressed_(std::move(pressed)),
      listener_(os::listenAt(path_, "Give a folder that can be written to, or leave out --live")) {
  thread_ = std::thread([this] { run(); });
}

StopPort::~StopPort() {
  ending_.wake();
  thread_.join();
  os::closeSocket(listener_);
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

void StopPort::run() {
  for (;;) {
    std::vector<os::WatchedSocket> all{{ending_.descriptor()}, {listener_}};
    for (const auto& presser : pressers_) all.push_back({presser->socket});
    os::waitForAny(all, kForever_ms);
    letIn();
    std::erase_if(pressers_, [this](const auto& presser) { return !hear(*presser); });
    if (os::ready(ending_.descriptor(), os::Wait::to_read, 0)) return;
  }
}

void StopPort::letIn() {
  if (!os::ready(listener_, os::Wait::to_read, 0)) return;
  const int socket = os::acceptOne(listener_);
  if (socket < 0) return runtime::rest(kNoDescriptor);
  if (!os::sameUser(socket)) return os::closeSocket(socket);
  if (pressers_.size() >= kMostPressers) pressers_.erase(pressers_.begin());
  pressers_.push_back(std::make_unique<Presser>(socket));
}

/// False: it has gone, or speaks another language.
bool StopPort::hear(Presser& presser) {
  char bytes[64];
  const std::optional<std::size_t> count = os::receiveSome(presser.socket, bytes, sizeof bytes);
  if (!count) return false;
  presser.decoder.feed(bytes, *count);
  try {
    while (const auto frame = presser.decoder.next()) {
      if (frame->kind != FrameKind::stop) return false;
      pressed_();
      const std::string confirmed = encoded(FrameKind::stop, "");
      os::sendSome(presser.socket, confirmed.data(), confirmed.size());
    }
  } catch (const Error&) {
    return false;
  }
  return true;
}

}  // namespace palpa::live
