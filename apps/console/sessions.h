#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "apps/console/place.h"
#include "apps/console/session_link.h"
#include "apps/os/child_process.h"

namespace palpa::console {

/// What an educator asks for when a session shall begin.
struct SessionWish {
  std::string task;                  ///< id of a task file
  std::string title = "";            ///< of the task, or of the study: what its pages call it
  std::string trainee;               ///< pseudonym; empty: nobody
  std::string performer = "person";  ///< person, expert, novice
  std::string side = "right";
  bool assess = false, force_feedback = true;
  bool sort = false;    ///< friction: several surfaces in order
  int fingers = 1;      ///< palpation: that press
  std::string surface;  ///< what lies on the virtual bench; empty: as the task has it
  int trials = 1;
  std::uint64_t seed = 1, patient_seed = 0;
  bool film = false;       ///< of the room: who trains has agreed, for this session
  std::string protocol;    ///< of a study: its file; the task then follows from it
  bool simulated = false;  ///< who performs, or the station
  std::string language;    ///< of its window: a code; empty: English
  bool blind = false;      ///< of a study: an educator must not be told what was drawn
  bool silent = false;     ///< no sound
};
/// Throws UsageError where a field is missing, of the wrong kind or out of range.
SessionWish readWish(const nlohmann::json& json);

/// The sessions that were begun from the console, each a process and a folder of its own; the
/// running ones are found again after a restart. At most one runs. Any thread.
class Sessions {
 public:
  explicit Sessions(const ConsolePlace& place);

  /// Starts one; throws UsageError where one runs already. `arguments`: of the command that holds
  /// it.
  std::string begin(const SessionWish& wish, std::vector<std::string> arguments);
  /// Newest first, as the pages take them.
  nlohmann::json list();
  nlohmann::json one(const std::string& id);  ///< throws UsageError where it is none
  std::filesystem::path folder(
      const std::string& id) const;  ///< throws UsageError where it is none
  std::filesystem::path results(const std::string& id)
      const;  ///< where its report is: the folder, or that of a study's newest block
  bool isBlind(const std::string& id) const;  ///< throws UsageError where it is none
  /// The same, to be shown; throws UsageError where the study is blind for educators: figures and
  /// pictures could tell what was drawn.
  std::filesystem::path shown(const std::string& id) const;
  /// Of a session that runs, or ran since the console began; null otherwise.
  std::shared_ptr<SessionLink> link(const std::string& id);
  /// The same without a look at files or processes: an emergency stop waits for neither.
  std::shared_ptr<SessionLink> linkForStop(const std::string& id) const;
  std::string running();  ///< id; empty: none runs
  bool oneRuns() { return !running().empty(); }
  /// The oldest of all that are over and of which the room has not heard all; empty: none. Those
  /// that are done are passed over, and those found to be are added. And that it has heard all of
  /// one.
  std::string firstUntold(std::set<std::string>* done);
  void markTold(const std::string& id);
  bool has(const std::string& id) const;
  std::string startOf(const std::string& id) const;  ///< UTC; throws Error where that is not known
  /// The records of one that is over, in their order; of a study's blocks one each.
  std::vector<std::filesystem::path> records(const std::string& id) const;
  /// Looks whether the running ones have ended; called now and then.
  void look();

 private:
  struct Running {
    os::ProcessId process;
    std::shared_ptr<SessionLink> link;
    bool over = false;
  };
  void find();
  void connect(const std::string& id, os::ProcessId process);
  nlohmann::json described(const std::string& id, const std::filesystem::path& folder);
  std::string stateOf(const std::string& id, const std::filesystem::path& folder);
  static nlohmann::json outcomeIn(const std::filesystem::path& folder,
                                  const nlohmann::json& described, int* read);
  std::string socketOf(const std::string& id) const;

  const ConsolePlace& place_;
  os::ProcessStarter starter_;
  std::mutex mutex_;
  std::map<std::string, Running> running_;
  mutable std::mutex links_mutex_;  ///< held for a moment only
  std::map<std::string, std::shared_ptr<SessionLink>> links_;
};

}  // namespace palpa::console
