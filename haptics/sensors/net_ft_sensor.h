#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <string>

#include "haptics/latest_value.h"
#include "haptics/sensors/force_sensor.h"
#include "haptics/sensors/rdt_protocol.h"
#include "haptics/sensors/udp_socket.h"

namespace palpa::haptics {

struct NetFtSettings {
  std::string address;  ///< in figures, as 192.168.1.1
  std::uint16_t port = kRdtPort;
  std::uint16_t local_port = 0;  ///< 0: any; a firewall may want a fixed one
  std::uint16_t start_code = kRdtStart;
  RdtScale scale;
  std::uint32_t saturation_bits = 0;    ///< of the status word, that mean saturated; models differ
  int wait_ms = 20;                     ///< longest wait of a step
  int answer_tries = 5;                 ///< starts sent before `start` gives up
  int answer_wait_ms = 200;             ///< wait for an answer to each
  std::int64_t silent_ns = 10'000'000;  ///< older than this: kSilent. As the tick's silent device
  std::int64_t restart_ns = 200'000'000;  ///< start again whenever nothing new came for so long
  ForceSensorCapabilities capabilities;
};

/// What has come and gone since the sensor was opened.
enum class NetFtCount : std::uint8_t {
  records,       ///< taken: newer than all before
  lost,          ///< numbers left out by the stream; a late one stays counted here
  duplicates,    ///< dropped
  late,          ///< dropped: overtaken by a newer one
  wrong_length,  ///< datagrams dropped whole
  faults,        ///< records with a status other than 0; they are delivered with kFault
  restarts,      ///< starts sent because of silence
  errors,        ///< the system refused to send or receive
};
inline constexpr std::size_t kNetFtCounts = 8;

/// ATI Net F/T or Ethernet Axia over UDP. Three threads at most: `step` again and again in one of
/// the sensor's own, `read` in the haptic thread, `requestBias` and `count` in any. Stops the
/// stream when destroyed; end the thread that steps before.
class NetFtSensor final : public ForceSensor {
 public:
  using Now = std::function<std::int64_t()>;  ///< session time, ns; must not throw

  /// Opens the socket. Throws Error (no route, port taken) and UsageError (settings).
  NetFtSensor(NetFtSettings settings, Now now);
  ~NetFtSensor() override;

  /// Asks for the stream and waits for its first record. Throws Error when none comes.
  void start();

  /// Waits for one datagram, at most `wait_ms`, and takes it. Starts the stream again after
  /// silence. No allocation, lock or exception.
  void step() noexcept;

  /// The sensor makes its present load its zero: sent by the next step. Also takes the tool's
  /// weight away in its present orientation; a bias kept by the program is the better one where the
  /// tool turns.
  void requestBias() noexcept { bias_wanted_.store(true, std::memory_order_relaxed); }

  std::uint64_t count(NetFtCount what) const noexcept {
    return counts_[static_cast<std::size_t>(what)].load(std::memory_order_acquire);
  }

  const ForceSensorCapabilities& capabilities() const override { return settings_.capabilities; }
  WrenchSample read(std::int64_t now_ns) noexcept override;

 private:
  int ask(std::uint16_t command) noexcept;
  void askForStream(std::int64_t now_ns) noexcept;
  int receive(int timeout_ms) noexcept;
  bool take(std::size_t datagram_bytes, std::int64_t now_ns) noexcept;
  bool account(const RdtRecord& record) noexcept;
  void publish(const RdtRecord& record, std::int64_t now_ns) noexcept;
  void add(NetFtCount what, std::uint64_t n = 1) noexcept;

  NetFtSettings settings_;
  Now now_;
  std::string where_;
  UdpSocket socket_;
  std::array<std::uint8_t, kRdtDatagramBytes> datagram_{};
  RdtSequence sequence_;
  std::int64_t received_ns_ = 0;  ///< when a fresh record came, or the stream was asked for
  bool asked_ = false;
  LatestValue<WrenchSample> latest_;
  std::atomic<bool> bias_wanted_{false};
  std::array<std::atomic<std::uint64_t>, kNetFtCounts> counts_{};
};

}  // namespace palpa::haptics
