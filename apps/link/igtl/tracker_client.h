#pragma once

#include <functional>
#include <memory>
#include <string>

#include "apps/link/igtl/wire.h"
#include "apps/os/tcp_socket.h"
#include "apps/runtime/activity.h"
#include "apps/runtime/bus.h"
#include "apps/runtime/clock.h"

namespace palpa::igt {

struct TrackerSettings {
  std::string host = "localhost";
  std::uint16_t port = 18944;
  /// "ReferenceToCamera": the pose of the table's marker R in the camera's marker K
  std::string transform;
  Pose X_CK = Pose::Identity();  ///< the camera's marker in the camera
  Pose X_RW = Pose::Identity();  ///< the board in the table's marker
  /// Ask for TDATA at this resolution, for senders that do not send by themselves; 0: do not ask
  int tracking_ms = 0;
  double latency_s = 0;  ///< from the measurement to the arrival here
};

/// What came of a tracking system's messages.
struct TrackerCounts {
  std::uint64_t poses = 0;      ///< taken
  std::uint64_t unusable = 0;   ///< the sender says so: status not OK, not valid
  std::uint64_t not_rigid = 0;  ///< NaN, scale, mirror, farther than 100 m
  std::uint64_t damaged = 0, skipped = 0;
  std::uint64_t connections = 0;  ///< 1: the first has held
};

/// How far the connection to a tracker is.
enum class TrackerState { apart, connecting, together };

/// DEVICE: reads one transform from a PLUS server (or any that speaks OpenIGTLink), as TRANSFORM or
/// out of TDATA, and passes X_CW = X_CK X_KR X_RW on to the camera's activity with the session time
/// at which it was measured (arrival less latency). Real time only; a step lasts until something
/// comes, at most `kWait_ms`. Connects by itself, and again whenever the connection is lost, ends
/// in something that is no OpenIGTLink, or is silent for `kSilent_ns`: after 0.25 s, then twice
/// that, ... at most 4 s; after silence always 0.25 s. A queue that nobody empties costs the newest
/// poses, no time.
class TrackerClient final : public runtime::Activity {
 public:
  static constexpr int kWait_ms = 20;
  static constexpr std::int64_t kSilent_ns = 5'000'000'000, kFirstPause_ns = 250'000'000,
                                kLongestPause_ns = 4'000'000'000;

  /// Throws UsageError where the host is not known or the transform has no name.
  TrackerClient(const TrackerSettings& settings, const runtime::Clock& clock,
                runtime::EventQueue<runtime::TrackedPose>& poses);
  const char* name() const override { return "tracker"; }
  std::int64_t step(std::int64_t now_ns) override;
  void end() noexcept override;

  TrackerCounts counts() const;  ///< after the last step, or on its thread

 private:
  void connect(std::int64_t now_ns);
  void part(std::int64_t now_ns);
  void greet();
  void receive(std::int64_t now_ns);
  void take(const Message& message);
  void take(const std::string& name, const Mat4& X_mm,
            const std::map<std::string, std::string>& metadata, bool among_others);

  const TrackerSettings settings_;
  const std::string ipv4_;
  const runtime::Clock& clock_;
  runtime::EventQueue<runtime::TrackedPose>& poses_;
  TrackerState state_ = TrackerState::apart;
  os::TcpSocket socket_;
  MessageStream stream_;
  std::int64_t next_try_ns_ = 0, pause_ns_ = kFirstPause_ns,
               since_ns_ = 0;  ///< since: began to connect, or heard last
  TrackerCounts counts_;       // of streams that have ended, with what is not a stream's
};

}  // namespace palpa::igt
