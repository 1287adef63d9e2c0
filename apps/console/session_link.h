#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "apps/runtime/clock.h"

namespace palpa::console {

/// The console's end of a running session's socket: what the session has told, its newest picture,
/// and a way to ask for something. Connects anew where the connection is lost; the session tells
/// its log from the beginning then, and what is known already is passed over. The newest entries
/// are kept, however long the session is. Any thread.
class SessionLink {
 public:
  /// `blind`: only what whoever must not know its condition may hear is kept (blinding.h), and
  /// there are no pictures.
  explicit SessionLink(std::string socket, bool blind = false);
  ~SessionLink();

  struct News {
    /// Number of the first of them: what was asked for, or 0 where the log is shorter than that.
    /// Where it is not kept any more, all that is kept follows on two entries in place of the older
    /// ones: the session's first, and {"kind": "earlier", "count"}.
    std::size_t from = 0;
    std::vector<std::string> entries;  ///< at most kMostAtOnce
    bool over = false;                 ///< the session told its last
  };
  static constexpr std::size_t kMostAtOnce = 1024;
  static constexpr std::size_t kMostKept = 20'000;  ///< half an hour, and a few MB
  /// Entries from number `from`; waits for the first of them, at most `patience`. A number beyond
  /// the log's end, once all of it is here, is another log's: it is told from its beginning.
  News wait(std::size_t from, std::chrono::milliseconds patience);
  struct Picture {
    std::shared_ptr<const std::string> jpeg;  ///< null: none yet
    std::uint64_t number = 0;
  };
  /// The newest picture after number `after`; waits for it, at most `patience`. While somebody has
  /// asked within the last seconds the session draws them.
  Picture picture(std::uint64_t after, std::chrono::milliseconds patience);
  /// False: nobody is there to hear it.
  bool send(const std::string& command);
  enum class Stopped { yes, unconfirmed, nobody };
  /// The emergency stop, over a connection of its own: before everything that waits to be sent, and
  /// without this link's thread. Waits for the session's word at most a third of a second; where
  /// that does not come it is sent with the other requests as well.
  Stopped stop();
  /// The session has ended: `last` becomes the log's last entry.
  void close(const std::string& last);
  bool hasReported() const;  ///< it has said something

 private:
  void run();
  void speak(int socket);
  bool receive(int socket, class LinkReader& reader);
  void take(const std::string& entry);
  void keep(const std::string& entry);
  std::size_t end() const { return first_ + entries_.size(); }
  bool watched() const;
  bool caughtUp() const { return over_ || passed_ >= known_; }

  const std::string path_;
  const bool blind_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::string> entries_;
  std::size_t first_ = 0;  ///< number of the oldest that is kept
  /// Where the present session's log begins in ours; how many of it came on this connection
  std::size_t begun_ = 0, passed_ = 0;
  std::size_t known_ = SIZE_MAX;  ///< how many there were when it began
  std::string hello_;
  std::vector<std::string> commands_;
  Picture picture_;
  runtime::ServingClock::time_point asked_{};
  bool connected_ = false, over_ = false;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace palpa::console
