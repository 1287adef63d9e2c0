#include "apps/link/igtl/tracker_client.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "anatomy/base/error.h"
#include "apps/link/igtl/conventions.h"

namespace palpa::igt {
namespace {

constexpr std::int64_t kConnectPatience_ns = 2 * runtime::kSecond;
constexpr std::size_t kMostBytes = 1 << 20;  // taken in one step

std::string valueOf(const std::map<std::string, std::string>& metadata, const std::string& key,
                    const std::string& otherwise) {
  const auto found = metadata.find(key);
  return found == metadata.end() ? otherwise : found->second;
}

}  // namespace

TrackerClient::TrackerClient(const TrackerSettings& settings, const runtime::Clock& clock,
                             runtime::EventQueue<runtime::TrackedPose>& poses)
    : settings_(settings),
      ipv4_(os::ipv4Of(settings.host, "tracker")),
      clock_(clock),
      poses_(poses) {
  if (settings_.transform.empty())
    throw UsageError("has no name", "the tracker's transform",
                     "Name one that its server sends, such as ReferenceToCamera");
}

std::int64_t TrackerClient::step(std::int64_t now_ns) {
  switch (state_) {
    case TrackerState::apart:
      if (now_ns < next_try_ns_)
        return std::min(next_try_ns_, now_ns + kWait_ms * runtime::kMillisecond);
      connect(now_ns);
      break;
    case TrackerState::connecting:
      if (const auto progress = socket_.connected(kWait_ms);
          progress == os::TcpSocket::Progress::done)
        greet();
      else if (progress == os::TcpSocket::Progress::failed ||
               now_ns - since_ns_ > kConnectPatience_ns)
        part(now_ns);
      break;
    case TrackerState::together:
      receive(now_ns);
      break;
  }
  return now_ns;
}

void TrackerClient::end() noexcept { socket_.close(); }

void TrackerClient::connect(std::int64_t now_ns) {
  socket_ = os::TcpSocket::connecting(ipv4_, settings_.port);
  state_ = TrackerState::connecting;
  since_ns_ = now_ns;
}

/// The next try comes later from time to time, until a message came or a connection held.
void TrackerClient::part(std::int64_t now_ns) {
  socket_.close();
  counts_.damaged += stream_.counts().damaged;
  counts_.skipped += stream_.counts().skipped;
  stream_ = MessageStream();
  state_ = TrackerState::apart;
  next_try_ns_ = now_ns + pause_ns_;
  pause_ns_ = std::min(2 * pause_ns_, kLongestPause_ns);
}

void TrackerClient::greet() {
  state_ = TrackerState::together;
  since_ns_ = clock_.now();
  ++counts_.connections;
  if (settings_.tracking_ms > 0)
    socket_.send(startTrackingMessage("Palpa", {settings_.tracking_ms, ""}, 0));
}

void TrackerClient::receive(std::int64_t now_ns) {
  std::array<std::uint8_t, 16384> buffer;
  int wait_ms = kWait_ms;
  for (std::size_t total = 0; total < kMostBytes; wait_ms = 0) {
    const std::size_t got = socket_.receive(buffer, wait_ms);
    if (got == 0) break;
    total += got;
    stream_.feed(View(buffer).first(got));
    while (const auto message = stream_.next()) take(*message);
  }
  const bool silent = now_ns - since_ns_ > kSilent_ns;
  if (silent)
    pause_ns_ =
        kFirstPause_ns;  // markers may only be out of sight: be there again when they are back
  if (silent || !socket_.open() || stream_.broken()) part(now_ns);
}

void TrackerClient::take(const Message& message) {
  since_ns_ = clock_.now();
  pause_ns_ = kFirstPause_ns;
  if (message.header.type == "TRANSFORM") {
    if (const auto X_mm = readTransform(message.content))
      take(valueOf(message.metadata, "IGTL_DEVICE_NAME", message.header.device), *X_mm,
           message.metadata, false);
    else
      ++counts_.damaged;
  }
  if (message.header.type != "TDATA") return;
  const auto tools = readTracking(message.content);
  if (!tools)
    ++counts_.damaged;
  else
    for (const NamedMatrix& tool : *tools) take(tool.name, tool.X_mm, message.metadata, true);
}

/// In TDATA a name is cut to what fits, and the status of each stands under its whole name.
void TrackerClient::take(const std::string& name, const Mat4& X_mm,
                         const std::map<std::string, std::string>& metadata, bool among_others) {
  const std::string& wanted = settings_.transform;
  if (name != wanted && name != wanted.substr(0, kLongestName)) return;
  const std::string status =
      valueOf(metadata, among_others ? wanted + "Status" : "TransformStatus", "OK");
  if (!mayBeUsed(status) ||
      (!among_others && valueOf(metadata, "TransformValid", "true") == "false")) {
    ++counts_.unusable;
    return;
  }
  const auto X_KR = fromWire(X_mm);
  if (!X_KR) {
    ++counts_.not_rigid;
    return;
  }
  ++counts_.poses;
  poses_.push({clock_.now() - std::llround(1e9 * settings_.latency_s),
               settings_.X_CK * *X_KR * settings_.X_RW});
}

TrackerCounts TrackerClient::counts() const {
  TrackerCounts all = counts_;
  all.damaged += stream_.counts().damaged;
  all.skipped += stream_.counts().skipped;
  return all;
}

}  // namespace palpa::igt
