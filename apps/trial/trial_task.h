#pragma once

#include <optional>
#include <vector>

#include "apps/runtime/activity.h"
#include "apps/runtime/bus.h"
#include "apps/runtime/camera_trouble.h"
#include "apps/runtime/executive.h"
#include "apps/training/trial_words.h"
#include "apps/trial/load_watch.h"
#include "apps/trial/trial_status.h"

namespace palpa::trial {

/// TASK, 60 Hz: leads through trials, whatever is trained in them: ready check, start, pause,
/// limits, end; what safety, device and camera have to say. What a trial is about says the task
/// that derives from this; it judges by the recorded ticks alone, so that a replay comes to the
/// same verdict.
class TrialTask : public runtime::Activity {
 public:
  struct Lead {
    int trials = 1;
    bool automatic = true;                    ///< starts trials by itself
    std::string calibration_problem;          ///< not empty: sessions are "not scored"
    std::vector<runtime::BoardPlace> places;  ///< of the boards besides the table's
    int tools = 1;                            ///< 2: a tick is two records
  };
  TrialTask(const Lead& lead, runtime::Bus& bus, Channels& channels, runtime::Executive& executive);

  /// Said with the first ready check, in the notice and in the evidence: of the device, what
  /// whoever holds it has to know. Before the first step.
  void warn(const std::string& of_device) { warnings_.push_back(of_device); }

  /// A window shows how the last trial ended until a person presses Enter, a minute at most.
  void stay() { stays_ = !lead_.automatic; }
  /// How the tool is moved: said in the window while nothing else is to be said; empty: it is not.
  void isMovedBy(const std::string& words) { moved_ = words; }

  /// What a trial is for, in a sentence: said in the window until the first begins; before each
  /// later one stands how the one before it ended.
  void isFor(const std::string& words) { above_ = words; }

  const char* name() const override { return "task"; }
  std::int64_t step(std::int64_t now_ns) override;

  bool quit() const { return quit_; }
  /// Those that are for the report, in order.
  const std::vector<runtime::Event>& safetyEvents() const { return safety_events_; }
  std::uint64_t lostTicks() const { return bus_.haptic_to_task.overflows(); }

 protected:
  /// Why the next trial cannot begin, by the newest tick; empty: it can.
  virtual std::string notReady(const haptics::FlightRecord& last) const = 0;
  /// The trial `status().trial` begins.
  virtual runtime::TrialHeader begin(std::int64_t now_ns) = 0;
  /// It ends; what is recorded of that: `scores_json` and, where there is no reason, the sentence.
  struct Conclusion {
    std::string scores_json, sentence;
    std::string result;   ///< told at once where the trial came to its end, see `endNotice`
    std::string caption;  ///< of the last picture
  };
  virtual Conclusion conclude(training::Outcome outcome, const std::string& reason) = 0;
  /// Every tick, trial or not.
  virtual void watch(const haptics::FlightRecord&) {}
  /// A tick while a trial runs or is paused.
  virtual void judge(const haptics::FlightRecord& record, std::int64_t now_ns) = 0;
  /// Of the trial that is on: what the loop must be told beside armed, stop and number.
  virtual void command(haptics::TickCommands& commands) const = 0;
  virtual void publishStatus(std::int64_t now_ns) = 0;
  /// What a person can do in the trial that runs, beside pausing it; empty: it needs no words.
  virtual std::string doing() const { return ""; }
  /// A request that only the task understands.
  virtual void receive(const UserRequest&, std::int64_t) {}

  void endTrial(training::Outcome outcome, const std::string& reason, std::int64_t now_ns);
  /// What is measured cannot be meant: no more force. Paused until somebody has looked after it;
  /// where nobody is there, the trial is void. `trouble`: a clause.
  void hold(const std::string& trouble, std::int64_t now_ns);
  void report(std::int64_t now_ns, runtime::EventKind kind, const std::string& text,
              double value = 0);
  void picture(const std::string& label, const std::string& caption);
  TrialStatus& status() { return status_; }
  const TrialStatus& status() const { return status_; }

 private:
  void note(const runtime::Event& event);
  void apply(std::int64_t now_ns);
  void apply(const UserRequest& request, std::int64_t now_ns);
  void watchStop(std::int64_t now_ns);
  void stopAll(std::int64_t now_ns);
  void rearm(std::int64_t now_ns);
  bool isMeant(const UserRequest& request, std::int64_t now_ns);
  void leave(const std::string& reason, std::int64_t now_ns);
  void goOn(std::int64_t now_ns);
  void listen(std::int64_t now_ns);
  void receiveDevice();
  void watchCamera(std::int64_t now_ns);
  std::string sightTrouble(const runtime::CameraView* view, std::int64_t now_ns);
  void watchSafety(const haptics::FlightRecord& record);
  std::string missing(std::int64_t now_ns);
  void checkReady(std::int64_t now_ns);
  bool isTooLong(std::int64_t now_ns);
  void becomeReady(std::int64_t now_ns);
  std::string sayWarnings(std::int64_t now_ns);
  void reportLoad(std::int64_t now_ns);
  void startTrial(std::int64_t now_ns);
  void publish(std::int64_t now_ns);
  std::string canDo() const;
  void escape(std::int64_t now_ns);
  void comeToAnEnd(std::int64_t now_ns);

  Lead lead_;
  bool stays_ = false;
  haptics::FlightRecord first_;  // of two tools, until the second one's is there
  runtime::Bus& bus_;
  Channels& channels_;
  runtime::Executive& executive_;
  const bool real_time_;
  TrialStatus status_;
  std::vector<runtime::Event> safety_events_;
  std::vector<std::string> warnings_;
  LoadWatch load_;
  haptics::FlightRecord last_;                               ///< newest tick seen
  std::string camera_ = runtime::cameraTrouble(nullptr, 0);  ///< what was last said of it
  std::optional<runtime::Displaced> displaced_;              ///< as it was last said
  std::int64_t trip_ns_ = 0,
               warm_ns_ = -1;         ///< of the last trip, of the last tick with warm drives
  std::int64_t since_ns_ = 0;         ///< the current state began
  std::int64_t check_since_ns_ = -1;  ///< `since_ns_` of this ready check
  std::uint64_t check_pictures_ = 0;  ///< shown before it
  std::uint32_t presses_seen_ = 0;    ///< of the emergency stop
  std::int64_t start_ns_ = 0;         ///< of the trial
  int pictures_ = 0;                  ///< asked for so far
  std::int64_t now_ns_ = 0;           ///< of this step
  bool quit_ = false;
  std::int64_t asked_to_leave_ns_ = -1;  ///< by Escape; -1: not, or taken back since
  std::string moved_, above_;
};

/// "safety", "device", a loss of the camera, a computer that did not keep up: a report's notes tell
/// of it.
bool isForTheReport(const runtime::Event& event);

}  // namespace palpa::trial
