#include "apps/console/session_link.h"

#include <cstdlib>

#include "apps/console/blinding.h"
#include "apps/live/wire.h"
#include "apps/os/local_socket.h"
#include "apps/os/real_time.h"
#include "apps/os/socket.h"

namespace palpa::console {

/// Frames of one connection.
class LinkReader {
 public:
  live::FrameDecoder decoder;
  bool watching = false;
};

namespace {

constexpr std::chrono::seconds kWatched{3};
constexpr std::chrono::milliseconds kTryAgain{100};
constexpr std::ptrdiff_t kLetGo = SessionLink::kMostKept / 10;  // of the oldest entries, at once
constexpr int kLook_ms = 50, kTakes_ms = 1000, kConfirmed_ms = 300;

bool sendAll(int socket, const std::string& bytes) {
  for (std::size_t sent = 0; sent < bytes.size();) {
    const std::optional<std::size_t> count =
        os::sendSome(socket, bytes.data() + sent, bytes.size() - sent);
    if (!count) return false;
    sent += *count;
    if (sent < bytes.size() && !os::ready(socket, os::Wait::to_write, kTakes_ms)) return false;
  }
  return true;
}

}  // namespace

SessionLink::SessionLink(std::string socket, bool blind) : path_(std::move(socket)), blind_(blind) {
  thread_ = os::startThread([this] { run(); });
}

SessionLink::~SessionLink() {
  ending_.store(true);
  thread_.join();
}

void SessionLink::run() {
  os::giveWay();
  while (!ending_.load()) {
    if (const int socket = os::connectTo(path_); socket >= 0) {
      speak(socket);
      os::closeSocket(socket);
    }
    {
      const std::lock_guard lock(mutex_);
      connected_ = false;
      if (over_) return;
    }
    runtime::rest(kTryAgain);
  }
}

void SessionLink::speak(int socket) {
  LinkReader reader;
  {
    const std::lock_guard lock(mutex_);
    connected_ = true;
    passed_ = 0;
    known_ = SIZE_MAX;
  }
  while (!ending_.load()) {
    std::string out;
    {
      const std::lock_guard lock(mutex_);
      if (over_) return;
      if (watched() != reader.watching) {
        reader.watching = !reader.watching;
        out += live::encoded(live::FrameKind::watch, reader.watching ? "1" : "0");
      }
      for (const std::string& command : commands_)
        out += live::encoded(live::FrameKind::command, command);
      commands_.clear();
    }
    if (!out.empty() && !sendAll(socket, out)) return;
    if (os::ready(socket, os::Wait::to_read, kLook_ms) && !receive(socket, reader)) return;
  }
}

bool SessionLink::receive(int socket, LinkReader& reader) {
  char bytes[65536];
  const std::optional<std::size_t> count = os::receiveSome(socket, bytes, sizeof bytes);
  if (count.value_or(0) == 0) return count.has_value();
  reader.decoder.feed(bytes, *count);
  try {
    while (const auto frame = reader.decoder.next()) {
      const std::lock_guard lock(mutex_);
      if (frame->kind == live::FrameKind::known)
        known_ = std::strtoull(frame->body.c_str(), nullptr, 10);
      if (frame->kind == live::FrameKind::entry) take(blind_ ? blinded(frame->body) : frame->body);
      if (frame->kind == live::FrameKind::picture)
        picture_ = {std::make_shared<const std::string>(frame->body), picture_.number + 1};
    }
  } catch (const Error&) {
    return false;
  }
  changed_.notify_all();
  return true;
}

/// The first entry of a connection tells which session it is: the one known already goes on where
/// it was.
void SessionLink::take(const std::string& entry) {
  if (passed_ == 0 && entry != hello_) {
    hello_ = entry;
    begun_ = end();
  }
  if (begun_ + passed_ >= end()) keep(entry);
  ++passed_;
}

void SessionLink::keep(const std::string& entry) {
  entries_.push_back(entry);
  if (entries_.size() <= kMostKept) return;
  entries_.erase(entries_.begin(), entries_.begin() + kLetGo);
  first_ += kLetGo;
}

bool SessionLink::watched() const { return runtime::ServingClock::now() - asked_ < kWatched; }

SessionLink::News SessionLink::wait(std::size_t from, std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, patience,
                    [&] { return end() > from || over_ || (caughtUp() && from > end()); });
  News news;
  news.over = over_;
  news.from = caughtUp() && from > end() ? 0 : from;
  if (news.from < first_) {
    news.entries = {hello_, R"({"kind":"earlier","count":)" + std::to_string(first_) + "}"};
    news.from = first_ - news.entries.size();
  }
  for (std::size_t i = news.from + news.entries.size();
       i < end() && news.entries.size() < kMostAtOnce; ++i)
    news.entries.push_back(entries_[i - first_]);
  return news;
}

SessionLink::Picture SessionLink::picture(std::uint64_t after, std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  if (blind_) return {};
  asked_ = runtime::ServingClock::now();
  changed_.wait_for(lock, patience, [&] { return picture_.number > after || over_; });
  return picture_.number > after ? picture_ : Picture{};
}

bool SessionLink::send(const std::string& command) {
  const std::lock_guard lock(mutex_);
  if (!connected_ || over_) return false;
  commands_.push_back(command);
  return true;
}

SessionLink::Stopped SessionLink::stop() {
  const int socket = os::connectTo(live::stopSocketOf(path_));
  const std::string press = live::encoded(live::FrameKind::stop, "");
  bool confirmed = false;
  if (socket >= 0) {
    char answer[64];
    confirmed = os::sendSome(socket, press.data(), press.size()) == press.size() &&
                os::ready(socket, os::Wait::to_read, kConfirmed_ms) &&
                os::receiveSome(socket, answer, sizeof answer).value_or(0) > 0;
    os::closeSocket(socket);
  }
  if (confirmed) return Stopped::yes;
  return send("{\"command\":\"stop\"}") || socket >= 0 ? Stopped::unconfirmed : Stopped::nobody;
}

void SessionLink::close(const std::string& last) {
  const std::lock_guard lock(mutex_);
  if (over_) return;
  keep(last);
  over_ = true;
  changed_.notify_all();
}

bool SessionLink::hasReported() const {
  const std::lock_guard lock(mutex_);
  return !entries_.empty();
}

}  // namespace palpa::console
