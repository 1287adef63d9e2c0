#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <list>
#include <string>
#include <vector>

namespace palpa::os {

/// How a worker tells something to the process that started it: one line.
using Report = std::function<void(const std::string& line)>;

/// What is new of a worker.
struct WorkerNews {
  std::size_t item = 0;            ///< that it works on
  std::vector<std::string> lines;  ///< that it reported, in order
  bool ended = false;
  /// Of one that has ended: what it threw, or that it was killed ("its process was ended by signal
  /// SEGV"); empty: it went through its work.
  std::string failure;
};

/// Pieces of work, each in a process of its own: one that crashes costs that piece. A process has
/// a copy of everything that was there when it began, and ends with the one that started it.
/// Nothing that is open (a database) may be used by both. One thread.
class WorkerPool {
 public:
  explicit WorkerPool(std::size_t most);  ///< at a time
  ~WorkerPool();                          ///< ends those that still run, and waits for them
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  bool isFull() const { return workers_.size() >= most_; }
  bool isIdle() const { return workers_.empty(); }
  /// Needs room. Where the system gives no further process: Error if none runs, else waits for the
  /// end of one and tries again; its news come with the next `await`.
  void start(std::size_t item, const std::function<void(const Report&)>& work);
  /// What has happened since; waits at most so long for something. Empty: nothing has.
  std::vector<WorkerNews> await(std::int64_t at_most_ns);
  /// Asks all to end, as SIGTERM does. Their ends are news.
  void askToEnd();

 private:
  struct Worker {
    std::size_t item = 0;
    int pid = 0, line = -1;
    std::string unread = {};
    std::vector<std::string> lines = {};
    std::string failure = {};
    bool went_through = false, ended = false;
  };
  bool tryStart(std::size_t item, const std::function<void(const Report&)>& work);
  void readLines(Worker& worker);
  std::vector<WorkerNews> takeNews();

  const std::size_t most_;
  std::list<Worker> workers_;
};

/// What this process prints from now on goes to the end of this file, which is this user's alone.
/// Throws Error.
void sendOutputTo(const std::filesystem::path& file);

/// How many processors this process may use; at least 1.
int processorsForUs();

}  // namespace palpa::os
