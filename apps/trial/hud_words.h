#pragma once

#include <string>

#include "anatomy/geometry/pose.h"
#include "apps/trial/trial_status.h"
#include "haptics/flight_record.h"
#include "scene/scene_state.h"

/// What every task's screen says in words.
namespace palpa::trial {

/// "within 0.4 mm": how far off the overlay may be, for 95 of 100 moments.
std::string overlayText(const Mat3& covariance);
/// What a trip means for whoever holds the tool; empty: nothing to say.
std::string forceText(haptics::SafetyCause cause);
/// Of two tools' causes the one of which there is something to say; else the first that is one.
haptics::SafetyCause worse(haptics::SafetyCause first, haptics::SafetyCause second);
/// Why force was taken away, as part of a sentence: "the device was silent".
std::string whyText(haptics::SafetyCause cause);
/// Which trial it is, in front of what is to be done in it: "Trial 1 of 2  ". `called`: "Trial".
std::string numberOf(const TrialStatus& status, const char* called);
/// What every task shows of a trial: which it is, what is to be done, force (in words) and time.
void tellTrial(const TrialStatus& status, const std::string& task, const std::string& force,
               scene::Hud* hud);
/// The line of advice that every task has: its own, trouble with force, device, camera; in this
/// order. Sets the alarm.
void noticeOf(const TrialStatus& status, haptics::SafetyCause safety, const std::string& own,
              const std::string& camera, scene::Hud* hud);

}  // namespace palpa::trial
