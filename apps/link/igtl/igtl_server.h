#pragma once

#include <deque>
#include <list>
#include <map>

#include "apps/link/igtl/wire.h"
#include "apps/os/tcp_socket.h"

namespace palpa::igt {

/// One who listens to a server. What is to be sent waits here, bounded: of a state (a transform, a
/// force) the newest replaces the one that is not on its way yet, of events the oldest
/// `kMostEvents` give way. So one who reads slowly, or not at all, costs neither time nor memory.
class Peer {
 public:
  static constexpr std::size_t kMostEvents = 256;
  Peer(os::TcpSocket socket, std::int64_t now_ns) : socket_(std::move(socket)), moved_ns_(now_ns) {}

  void state(const std::string& key, Bytes message) { states_[key] = std::move(message); }
  void event(Bytes message);
  /// Sends as much as the connection takes.
  void flush(std::int64_t now_ns);
  /// What was asked since the last call.
  std::vector<Message> requests();

  /// Still there, speaking OpenIGTLink, and has taken something within the last `kPatience_ns` if
  /// something waits.
  static constexpr std::int64_t kPatience_ns = 30'000'000'000;
  bool alive(std::int64_t now_ns) const {
    return socket_.open() && !stream_.broken() && (idle() || now_ns - moved_ns_ < kPatience_ns);
  }

  struct TrackingStream {
    bool on = false;
    std::int64_t period_ns = 0, next_ns = 0;
    std::string coordinates;
  };
  TrackingStream tracking;  ///< TDATA, where it was asked for
  std::uint64_t lostEvents() const { return lost_events_; }

 private:
  bool idle() const { return sent_ == sending_.size() && events_.empty() && states_.empty(); }
  bool takeNext();

  os::TcpSocket socket_;
  MessageStream stream_;
  Bytes sending_;         ///< the message on its way
  std::size_t sent_ = 0;  ///< bytes of it
  std::deque<Bytes> events_;
  std::map<std::string, Bytes> states_;
  std::int64_t moved_ns_;  ///< when the connection last took something, or nothing waited
  std::uint64_t lost_events_ = 0;
};

struct NamedPose {
  std::string from;  ///< "NeedleTip": its pose in W
  Pose X_W = Pose::Identity();
  std::int64_t utc_ns = 0;
};
struct NamedForce {
  std::string name;         ///< "NeedleContactForce"
  Vec3 f_W = Vec3::Zero();  ///< N, on the tool
};

/// What is shown of a moment. What is not known at it is not in it: PLUS' way of saying that a
/// transform is not to be used, for those who read no metadata.
struct ShownMoment {
  std::int64_t utc_ns = 0;  ///< of forces, lengths and the whole
  std::vector<NamedPose> poses;
  std::vector<NamedForce> forces;
  std::vector<std::pair<std::string, double>> lengths_mm;
};

/// Serves a session's moments to whoever connects (3D Slicer, PLUS' client, any OpenIGTLink
/// client). One thread; no call waits for anybody.
///
/// TRANSFORM, SENSOR at the pace of `show`; STRING when something is said; TDATA, all poses in one
/// message, to those who sent STT_TDATA, no more often than the resolution they asked for, until
/// STP_TDATA; GET_STATUS is answered. Requests may come with header version 1 or 2; answers go out
/// with version 1.
class IgtlServer {
 public:
  static constexpr std::size_t kMostPeers = 8;  ///< more are turned away
  static constexpr const char* kDevice = "Palpa";

  /// Throws UsageError (address), Error (port taken).
  IgtlServer(const std::string& ipv4, std::uint16_t port, const Pose& X_WA);
  std::uint16_t port() const { return listener_.port(); }

  /// With every moment: the pose of `from` in `to`, which does not change.
  void showAlways(const std::string& from, const std::string& to, const Pose& X);
  /// The moment as TRANSFORM and SENSOR to all.
  void show(const ShownMoment& moment);
  /// STRING to all; one who connects later hears the last of each device that is `lasting`.
  void say(const std::string& device, const std::string& utf8, std::int64_t utc_ns,
           bool lasting = false);
  /// Accepts, answers, sends TDATA of `moment` where it is due, and what waits; forgets who is
  /// gone.
  void serve(const ShownMoment& moment, std::int64_t now_ns);

  std::size_t peers() const { return peers_.size(); }
  std::uint64_t everConnected() const { return ever_; }
  std::uint64_t lostEvents() const;

 private:
  void welcome(std::int64_t utc_ns, std::int64_t now_ns);
  void greet(Peer& peer, std::int64_t utc_ns);
  void answer(Peer& peer, const Message& request, const ShownMoment& moment, std::int64_t now_ns);
  std::vector<NamedMatrix> tools(const ShownMoment& moment, const std::string& coordinates) const;

  os::TcpListener listener_;
  const Pose X_RasW_;  ///< W in the patient's RAS frame
  std::list<Peer> peers_;
  std::map<std::string, Mat4> always_;
  std::map<std::string, std::string> lasting_;
  std::uint64_t ever_ = 0, lost_events_ = 0;
};

}  // namespace palpa::igt
