#include "apps/live/stop_port.h"

#include <utility>

#include "apps/live/wire.h"
#include "apps/os/real_time.h"
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

StopPort::StopPort(const std::string& path, std::function<void()> pressed)
    : pressed_(std::move(pressed)),
      listener_(path, "Give a folder that can be written to, or leave out --live") {
  thread_ = os::startThread([this] { run(); });
}

StopPort::~StopPort() {
  ending_.wake();
  thread_.join();
}

void StopPort::run() {
  for (;;) {
    std::vector<os::WatchedSocket> all{{ending_.descriptor()}, {listener_.socket()}};
    for (const auto& presser : pressers_) all.push_back({presser->socket});
    os::waitForAny(all, kForever_ms);
    letIn();
    std::erase_if(pressers_, [this](const auto& presser) { return !hear(*presser); });
    if (os::ready(ending_.descriptor(), os::Wait::to_read, 0)) return;
  }
}

void StopPort::letIn() {
  if (!os::ready(listener_.socket(), os::Wait::to_read, 0)) return;
  const int socket = os::acceptOne(listener_.socket());
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
