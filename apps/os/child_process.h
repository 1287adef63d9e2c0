#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <future>
#include <mutex>
#include <queue>
#include <string>
#include <thread>
#include <vector>

namespace palpa::os {

/// A process of this program, as it can be found again by another one later.
struct ProcessId {
  int pid = 0;
  /// Of the kernel, ticks since boot: tells it from a later process with the same number.
  std::uint64_t began = 0;
  bool operator==(const ProcessId&) const = default;
};

/// Starts this program anew with `arguments`: in a session of its own, so that it outlives whoever
/// started it; output goes to `log`; nothing of ours stays open in it. Throws Error.
ProcessId start(const std::vector<std::string>& arguments, const std::filesystem::path& log,
                bool gives_way);
/// As `start`, of an installed program instead: `program` is its file.
ProcessId startInstalled(const std::filesystem::path& program,
                         const std::vector<std::string>& arguments,
                         const std::filesystem::path& log);
/// Starts processes as `start` does, at the priority of the thread that made this. What a thread
/// starts inherits its priority and may not raise it: a session that a server's thread starts,
/// which gives way to all others, would give way as well, its haptic thread with it.
class ProcessStarter {
 public:
  ProcessStarter();
  ~ProcessStarter();
  ProcessStarter(const ProcessStarter&) = delete;
  ProcessStarter& operator=(const ProcessStarter&) = delete;

  /// Any thread, which waits for it. Throws Error.
  ProcessId start(const std::vector<std::string>& arguments, const std::filesystem::path& log);

 private:
  void run();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::queue<std::packaged_task<ProcessId()>> asked_;
  bool ending_ = false;
  std::thread thread_;
};
/// As `start`, silent, and with a line to it: what is sent there (see socket.h) it receives at its
/// descriptor 0, and that line ends however this process does. Throws Error.
struct Companion {
  ProcessId process;
  int line = -1;  ///< whoever has it closes it
};
Companion startWithLine(const std::vector<std::string>& arguments);
/// As `start`, waited for: what it took, by the system's own count.
struct Spent {
  int exit_code = -1;                   ///< -1: it was ended by a signal
  double processor_s = 0, peak_MB = 0;  ///< peak: of memory in use at once, 1 MB = 1e6 bytes
};
Spent runToEnd(const std::vector<std::string>& arguments, const std::filesystem::path& log);

/// It runs. A child of ours that ended is put away.
bool runs(const ProcessId& process);
/// Asks it to end, as Ctrl-C does.
void askToEnd(const ProcessId& process);
/// It is stopped, as by Ctrl-Z; not by a debugger.
bool isStopped(const ProcessId& process);
/// Ends it, whatever it does.
void endAtOnce(const ProcessId& process);

/// This process becomes the program anew, with `arguments`: its number stays, and whatever hangs in
/// it is gone. Comes back only where that cannot be.
void becomeAnew(const std::vector<std::string>& arguments);

/// Starts an installed program, found as a shell finds it, and leaves it alone. False: there is
/// none of this name.
bool startProgram(const std::string& name, const std::vector<std::string>& arguments);

/// Of this process; no other running one has it.
int processNumber();
ProcessId thisProcess();
/// The name of its file: "palpa", and in a test the test's.
std::string programName();

}  // namespace palpa::os
