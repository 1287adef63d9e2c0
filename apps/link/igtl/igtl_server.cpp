#include "apps/link/igtl/igtl_server.h"

#include <algorithm>
#include <array>

#include "apps/link/igtl/conventions.h"

namespace palpa::igt {
namespace {

constexpr std::size_t kMostRequestBytes =
    64 * 1024;  // taken in one call, so that nobody who floods keeps the server

}  // namespace

void Peer::event(Bytes message) {
  if (events_.size() >= kMostEvents) {
    events_.pop_front();
    ++lost_events_;
  }
  events_.push_back(std::move(message));
}

/// Events first: a state comes again. False: nothing waits.
bool Peer::takeNext() {
  sent_ = 0;
  sending_.clear();
  if (!events_.empty()) {
    sending_ = std::move(events_.front());
    events_.pop_front();
    return true;
  }
  if (states_.empty()) return false;
  sending_ = std::move(states_.begin()->second);
  states_.erase(states_.begin());
  return true;
}

void Peer::flush(std::int64_t now_ns) {
  if (idle()) moved_ns_ = now_ns;
  while (socket_.open() && (sent_ < sending_.size() || takeNext())) {
    const std::size_t taken = socket_.send(View(sending_).subspan(sent_));
    if (taken == 0) return;
    sent_ += taken;
    moved_ns_ = now_ns;
  }
}

std::vector<Message> Peer::requests() {
  std::vector<Message> requests;
  std::array<std::uint8_t, 4096> buffer;
  for (std::size_t total = 0; total < kMostRequestBytes;) {
    const std::size_t got = socket_.receive(buffer);
    if (got == 0) break;
    total += got;
    stream_.feed(View(buffer).first(got));
    while (auto message = stream_.next()) requests.push_back(std::move(*message));
  }
  return requests;
}

namespace {

constexpr std::int64_t kMillisecond = 1'000'000;
constexpr std::int64_t kLongestPeriod_ms = 60'000;
constexpr int kMostKnocks = 16;

bool isTable(const std::string& coordinates) {
  return coordinates.empty() || coordinates == kReference;
}
bool isAnatomy(const std::string& coordinates) {
  return coordinates == kPatient || coordinates == kRas || coordinates == "RAS";
}

}  // namespace

IgtlServer::IgtlServer(const std::string& ipv4, std::uint16_t port, const Pose& X_WA)
    : listener_(ipv4, port, "OpenIGTLink",
                "Choose another port, or end the program that holds it (3D Slicer's or PLUS' "
                "server use 18944 too)"),
      X_RasW_((X_WA * rasInAnatomy()).inverse()) {
  showAlways(kReference, kRas, X_RasW_);
  showAlways(kPatient, kReference, X_RasW_.inverse());
}

void IgtlServer::showAlways(const std::string& from, const std::string& to, const Pose& X) {
  always_[toName(from, to)] = toWire(X);
}

void IgtlServer::show(const ShownMoment& moment) {
  for (const NamedPose& pose : moment.poses) {
    const std::string name = toName(pose.from, kReference);
    const Bytes message = transformMessage(name, toWire(pose.X_W), pose.utc_ns);
    for (Peer& peer : peers_) peer.state(name, message);
  }
  for (const auto& [name, X_mm] : always_) {
    const Bytes message = transformMessage(name, X_mm, moment.utc_ns);
    for (Peer& peer : peers_) peer.state(name, message);
  }
  for (const NamedForce& force : moment.forces) {
    const Bytes message = sensorMessage(force.name, {force.f_W.x(), force.f_W.y(), force.f_W.z()},
                                        Quantity::newtons, moment.utc_ns);
    for (Peer& peer : peers_) peer.state(force.name, message);
  }
  for (const auto& [name, mm] : moment.lengths_mm) {
    const Bytes message = sensorMessage(name, {mm}, Quantity::millimetres, moment.utc_ns);
    for (Peer& peer : peers_) peer.state(name, message);
  }
}

void IgtlServer::say(const std::string& device, const std::string& utf8, std::int64_t utc_ns,
                     bool lasting) {
  if (lasting) lasting_[device] = utf8;
  for (Peer& peer : peers_) peer.event(stringMessage(device, utf8, utc_ns));
}

void IgtlServer::greet(Peer& peer, std::int64_t utc_ns) {
  for (const auto& [device, text] : lasting_) peer.event(stringMessage(device, text, utc_ns));
}

/// Of those who wait a few in one call: nobody who knocks without end keeps the others waiting.
void IgtlServer::welcome(std::int64_t utc_ns, std::int64_t now_ns) {
  for (int knocks = 0; knocks < kMostKnocks; ++knocks) {
    os::TcpSocket socket = listener_.accept();
    if (!socket.open()) return;
    if (peers_.size() >= kMostPeers) continue;  // turned away
    peers_.emplace_back(std::move(socket), now_ns);
    greet(peers_.back(), utc_ns);
    ++ever_;
  }
}

void IgtlServer::serve(const ShownMoment& moment, std::int64_t now_ns) {
  welcome(moment.utc_ns, now_ns);
  for (Peer& peer : peers_) {
    for (const Message& request : peer.requests()) answer(peer, request, moment, now_ns);
    if (peer.tracking.on && now_ns >= peer.tracking.next_ns) {
      peer.tracking.next_ns = now_ns + peer.tracking.period_ns;
      if (!moment.poses.empty())
        peer.state("TDATA",
                   trackingMessage(kDevice, tools(moment, peer.tracking.coordinates),
                                   moment.utc_ns));  // receivers take one of no tool for damage
    }
    peer.flush(now_ns);
  }
  for (auto peer = peers_.begin(); peer != peers_.end();) {
    if (peer->alive(now_ns)) {
      ++peer;
      continue;
    }
    lost_events_ += peer->lostEvents();
    peer = peers_.erase(peer);
  }
}

void IgtlServer::answer(Peer& peer, const Message& request, const ShownMoment& moment,
                        std::int64_t now_ns) {
  const std::string& type = request.header.type;
  if (type == "GET_STATUS")
    return peer.event(statusMessage(kDevice, "A session is running", moment.utc_ns));
  if (type == "STP_TDATA") {
    peer.tracking.on = false;
    return peer.event(trackingAnswer(kDevice, true, moment.utc_ns));
  }
  if (type != "STT_TDATA") return;
  const auto wanted = readTrackingRequest(request.content);
  const bool granted = wanted && (isTable(wanted->coordinates) || isAnatomy(wanted->coordinates));
  if (granted)
    peer.tracking = {
        true, kMillisecond * std::clamp<std::int64_t>(wanted->resolution_ms, 0, kLongestPeriod_ms),
        now_ns, wanted->coordinates};
  peer.event(trackingAnswer(kDevice, granted, moment.utc_ns));
}

/// The instrument's name alone: in which frame says the request. (The library loses names of 20
/// characters here.)
std::vector<NamedMatrix> IgtlServer::tools(const ShownMoment& moment,
                                           const std::string& coordinates) const {
  std::vector<NamedMatrix> tools;
  for (const NamedPose& pose : moment.poses)
    tools.push_back(
        {pose.from, toWire(isTable(coordinates) ? pose.X_W : Pose(X_RasW_ * pose.X_W))});
  return tools;
}

std::uint64_t IgtlServer::lostEvents() const {
  std::uint64_t lost = lost_events_;
  for (const Peer& peer : peers_) lost += peer.lostEvents();
  return lost;
}

}  // namespace palpa::igt
