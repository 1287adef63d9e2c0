#pragma once

#include <cstdint>
#include <string>

#include "apps/assess/phase_detector.h"

namespace palpa::task_needle {

enum class TrialState { checking, waiting, running, paused, ended, finished };

/// What the task tells the scene: for the HUD, the syringe, the pictures.
struct TaskStatus {
  TrialState state = TrialState::checking;
  int trial = 0;
  int trials = 0;
  std::string role;                    ///< "scored", "familiarisation", "demonstration"
  bool force_feedback = true;
  assess::ProcedurePhase phase = assess::ProcedurePhase::approach;
  double elapsed_s = 0;
  double plunger = 0, blood = 0;       ///< drawn, filled; fractions of the syringe
  bool blood_flows = false;
  bool emergency_stop = false;
  std::string device;               ///< what the device's driver has to say; empty: nothing
  haptics::SafetyCause trip = haptics::SafetyCause::none;   ///< the last one, for some seconds: many last a tick only
  std::string notice;                  ///< one line for the person
  bool alarm = false;
};

/// The scene shall keep a picture of this moment.
struct PictureRequest {
  int trial = 0;
  double t_s = 0;
  std::string label;     ///< part of the file name
  std::string caption;
};

/// What the person in charge wants (keys, console).
enum class UserCommand : std::uint8_t {
  start, pause, abort, void_trial, emergency_stop, rearm, quit
};
struct UserRequest {
  UserCommand command = UserCommand::start;
  std::string reason;    ///< of a void
};

}  // namespace palpa::task_needle
