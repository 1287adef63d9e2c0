#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/os/tls/certificates.h"

namespace palpa::room {

/// How a broker is reached, and as whom.
struct BrokerAccess {
  std::string host;
  int port = 8883;
  std::string authority;          ///< PEM: who vouches for the broker
  os::Identity identity{"", ""};  ///< shown to the broker, which knows us by its name
};

struct Said {
  std::string topic, words;
  bool retained = false;  ///< the broker tells the newest to whoever comes later
  /// Words that mean something now only are not said later.
  std::optional<std::chrono::seconds> good_for = std::nullopt;
  bool urgent = false;  ///< it is said before all that waits
};

/// A line to an MQTT 5 broker over TLS, at QoS 1, with a thread of its own that gives way to all
/// others. A line that is lost, or on which the broker refuses something, is begun anew, after a
/// second, then later and later, at most 15 s; what was not taken until then is said again, in its
/// order. Any thread.
class BrokerLine {
 public:
  struct Wish {
    BrokerAccess access;
    Said last_will;                   ///< what the broker says when we are gone without a word
    std::vector<std::string> topics;  ///< that we listen to; with "+" for any one word
    /// Each time the line stands, before anything is heard; what is returned is said first. On the
    /// line's thread, as the next.
    std::function<std::vector<Said>()> greets;
    std::function<void(const Said&)> hears;
  };
  explicit BrokerLine(Wish wish);
  /// What was said is sent within two seconds, or not at all.
  ~BrokerLine();
  BrokerLine(const BrokerLine&) = delete;
  BrokerLine& operator=(const BrokerLine&) = delete;

  /// Later, in order. Of retained words the newest of a topic takes the place of one that was not
  /// sent yet; without a line more than kMostWaiting are not kept, the oldest go.
  void say(Said said);
  static constexpr std::size_t kMostWaiting = 1000;

  struct State {
    bool stands = false;  ///< the broker tells us whatever is said in our topics from here on
    std::string trouble;  ///< why it does not, or what the broker refused, and what to do about it
  };
  State state() const;

 private:
  struct Waiting;
  struct Shared;
  std::shared_ptr<Shared> shared_;  ///< with the thread: what hangs keeps what it uses
};

}  // namespace palpa::room
