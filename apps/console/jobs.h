#pragma once

#include <condition_variable>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "apps/console/place.h"
#include "apps/os/child_process.h"

namespace palpa::console {

/// How far a job is.
enum class JobState { waiting, running, done, failed };

/// A piece of work that is asked for.
struct JobRequest {
  std::string key;    ///< the same piece of work has the same key: it is not done twice at once
  std::string title;  ///< "Camera"
  std::vector<std::string> arguments;  ///< of the command; "{}" stands for the job's folder
  /// The file that shows what came out, in the folder or with its whole path; empty: none
  std::string page;
  /// on the jobs' thread
  std::function<void(const std::filesystem::path& folder, bool good)> then;
  /// the file in the folder that shows what the camera sees meanwhile; empty: none
  std::string picture = "";
};

/// Work in the background: commands of this program, one after the other, at low priority. Each has
/// a folder under jobs/ and a log there. Any thread.
class Jobs {
 public:
  explicit Jobs(const ConsolePlace& place);
  ~Jobs();  ///< what runs is asked to end

  /// The id of the job: the one with this key that waits or runs, else a new one.
  std::string add(JobRequest request);
  /// What becomes of a piece of work that is begun when it is asked for first, as one() tells it;
  /// of those that wait, the one that was asked for last is done next. A failure is told once:
  /// whoever asks again begins it anew.
  nlohmann::json ask(JobRequest request);
  /// {"state": "working|done|failed", "title", "done", "lines", "page", "message"}; throws
  /// UsageError for an unknown one.
  nlohmann::json one(const std::string& id);
  void stop(const std::string& id);
  std::filesystem::path picture(
      const std::string& id);                         ///< throws UsageError for a job that has none
  std::filesystem::path page(const std::string& id);  ///< throws UsageError for a job that has none
  /// Waits or runs with a key that begins so; empty: none.
  std::string workingOn(const std::string& prefix);

 private:
  struct Job {
    JobRequest request;
    JobState state = JobState::waiting;
    os::ProcessId process;
    bool stopped = false;
  };
  std::string addLocked(JobRequest request);
  void run();
  void perform(const std::string& id);

  const ConsolePlace& place_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, Job> jobs_;
  std::map<std::string, std::string> asked_;  ///< key -> job
  std::vector<std::string> queue_;
  bool ending_ = false;
  std::thread thread_;
};

/// How far, of the last line that says "3 of 20"; null: it does not say.
nlohmann::json fractionOf(const std::vector<std::string>& lines);

/// The last lines of a log, without what a terminal would make of them.
std::vector<std::string> lastLines(const std::filesystem::path& log, std::size_t most);
/// Of the last line that begins with "palpa: ": what went wrong; empty: nothing was said.
std::string complaintIn(const std::filesystem::path& log);

}  // namespace palpa::console
