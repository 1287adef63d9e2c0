#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "apps/runtime/channels.h"
#include "apps/training/trial_words.h"
#include "haptics/flight_record.h"

namespace palpa::trial {

enum class TrialState { checking, waiting, running, paused, ended, finished };

/// What every task tells the scene of where its trials stand.
struct TrialStatus {
  TrialState state = TrialState::checking;
  int trial = 0;
  int trials = 0;
  training::Role role = training::Role::none;
  bool force_feedback = true;
  double elapsed_s = 0;
  bool emergency_stop = false;
  std::string device;  ///< what the device's driver has to say; empty: nothing
  /// the last one, for some seconds: many last a tick only
  haptics::SafetyCause trip = haptics::SafetyCause::none;
  std::string notice;  ///< for the person: one line, or what a trial is for above it
  bool alarm = false;
  std::string can_do;  ///< what a person can do now; empty: nobody is there to read it
  bool active() const { return state == TrialState::running || state == TrialState::paused; }
};

/// What stands on the screen until the next trial: `result` where the trial came to its end, else
/// why, or how it ended; in an assessment neither, unless it was broken off, which judges nobody.
std::string endNotice(training::Role role, training::Outcome outcome, const std::string& result,
                      const std::string& reason = "");

/// The scene shall keep a picture of this moment.
struct PictureRequest {
  int trial = 0;
  double t_s = 0;
  std::string label;  ///< part of the file name
  std::string caption;
  int number = 0;  ///< of the session's requests: 1, 2, ...
};

/// "view-02-07-puncture.png": the session's seventh, of its second trial.
std::string pictureFile(const PictureRequest& request);
/// A request as its event records it, "view-02-07-puncture.png: The skin is punctured", and read
/// again; without a file for what is none.
std::string pictureText(const PictureRequest& request);
struct PictureInWords {
  std::string file, caption;
};
PictureInWords pictureIn(const std::string& text);

/// What the person in charge wants (keys, console), or whoever is being trained.
enum class UserCommand : std::uint8_t {
  start,
  pause,
  abort,
  void_trial,
  emergency_stop,
  rearm,
  quit,
  escape,  ///< as quit, but a trial that is on is paused first, and it is asked for again
  done,
  grade,
  choose,
  note,
  remark
};
struct UserRequest {
  UserCommand command = UserCommand::start;
  /// Of a void; of a grade: what was said, as the task writes it down; of a choice: the key, "0" to
  /// "9", or a whole number; of a note or of what a part of the computer has to say: its text
  std::string reason;
  /// Of a note: the session time it is about. Of a remark: 1 where the report is to say it
  double at_s = 0;
  /// Of a void or an abort: what it was meant for, which may have ended since; 0: whichever is on
  int trial = 0;
};

/// Between task, scene and whoever asks for something: one writer, one reader each.
struct Channels {
  runtime::EventQueue<PictureRequest> pictures_to_scene{64};
  runtime::EventQueue<UserRequest> requests_to_task{64};  ///< from the scene: keys
  runtime::EventQueue<UserRequest> signals_to_task{
      16};  ///< from the system: the session shall end, a part does not answer
  runtime::EventQueue<UserRequest> operator_to_task{8};  ///< from a simulated operator
  runtime::EventQueue<UserRequest> console_to_task{
      64};                               ///< from whoever looks on through the console
  std::atomic<std::uint64_t> frames{0};  ///< of the scene so far, for the task
};

}  // namespace palpa::trial

/// What a trainee says of something that was felt.
namespace palpa::trial {

/// A grade as it is recorded in an event's text, and read again: "diameter 16 mm, hard, fixed";
/// nothing for invalid words.
std::string gradeText(double diameter, int hardness, int mobility);
struct Grade {
  double diameter = 0;
  int hardness = 0, mobility = 0;
};
Grade gradeOf(const std::string& text);
/// Of a request: grades in words, or with a key: 1 soft, 2 hard, 3 fixed, 4 mobile, 5 to 8 a
/// diameter of 10, 15, 20, 25 mm. Nothing of any other.
Grade gradeOf(const UserRequest& request);

}  // namespace palpa::trial
