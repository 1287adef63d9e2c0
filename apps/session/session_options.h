#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "anatomy/patient.h"
#include "apps/assess/progress/standing.h"
#include "apps/presentation/presentation.h"
#include "apps/training/trial_words.h"
#include "scene/scene_state.h"
#include "scene/window/gl_context.h"

namespace palpa::station {
struct Station;
}

namespace palpa::runtime {
class StopSwitch;
}
namespace palpa::trial {
struct Channels;
}

namespace palpa::session {

enum class OperatorKind {
  automatic,
  person,
  expert,
  novice,
  custom,   ///< simulated, of a file of one's own
  learner,  ///< simulated, better from trial to trial
  recorded  ///< a replayed hand
};

inline bool isSimulated(OperatorKind who) {
  return who == OperatorKind::expert || who == OperatorKind::novice ||
         who == OperatorKind::custom || who == OperatorKind::learner;
}

/// By what the board is tracked: pictures, or on the virtual bench a model of the errors that
/// pictures would have caused.
enum class Tracking { images, model };

/// Of which study a session is part.
struct StudyStep {
  std::string id;         ///< the protocol's; empty: none
  std::int64_t slot = 0;  ///< 1, 2, ...: which block on the trainee's way through the study
  std::string group, condition, block;
  int step = 0;  ///< of the block: its trial with which the session begins, 1, 2, ...
  std::string protocol_sha256;
};

/// Who learns, where the operator is a simulated learner.
struct LearnerOptions {
  std::string from, to;  ///< operator files: whose figures he has at level 0 and at level 1
  std::function<double(int)> level;  ///< at the session's nth trial
  std::uint64_t seed = 0;            ///< of the hand's own chances; at the nth trial n - 1 more
};

/// What every session command understands.
struct SessionOptions {
  std::string command = "subclavian";
  std::string task;                ///< task file; empty: the shipped one
  std::string station;             ///< station file; empty: the virtual bench
  std::string patient;             ///< patient file; empty: built from the reference figures
  std::uint64_t patient_seed = 0;  ///< 0: the reference patient
  anatomy::Side side = anatomy::Side::right;
  bool left_handed = false;
  std::uint64_t seed = 1;
  /// of the virtual bench's truth, which a calibration of it belongs to; 0: as `seed`
  std::uint64_t bench_seed = 0;
  std::uint64_t benchSeed() const { return bench_seed ? bench_seed : seed; }
  OperatorKind who = OperatorKind::automatic;
  std::string operator_file;  ///< of a custom operator
  /// a simulated operator aims by this patient's images, not by the mean anatomy
  bool knows_patient = false;
  bool force_feedback = true;
  int trials = 1;
  std::string trainee = "T000";
  std::string records;  ///< where finished trials go; empty: nobody is recorded
  bool fast = false;
  bool no_views = false;
  Tracking tracking = Tracking::images;
  bool records_reached = true;          ///< when they were asked for the trainee
  std::vector<progress::Group> others;  ///< shown beside in the report: `meetOthers`
  std::string film_room;                ///< by this camera, or film; empty: not
  bool film_agreed = false;             ///< by who trains, for this session
  bool record_video = false;            ///< keep the camera's pictures
  std::optional<presentation::Presentation> presentation;  ///< empty: by role and force feedback
  bool hide_forces = false;      ///< a study's: those of other conditions do not feel them
  bool navigation = true;        ///< free navigation of the view
  bool skin_deflection = false;  ///< the skin is shown to give way
  bool guide = false;            ///< a line from the entry point to the vein: not scored
  scene::ForceColours force_colours = scene::ForceColours::paper;
  scene::Stereo stereo = scene::Stereo::none;
  scene::Inset inset = scene::Inset::none;
  bool demonstration = true;    ///< a person first watches an expert's recorded trial
  bool familiarisation = true;  ///< and then tries once, unscored
  scene::Display display = scene::Display::automatic;
  scene::WindowPlace window = {};  ///< width 0: as it was left last
  /// Somebody else at the station, in virtual time: asked a hundred times a second.
  std::function<void(std::int64_t now_ns, trial::Channels&, runtime::StopSwitch&)> meanwhile = {};
  bool headset = false;                   ///< beside the desktop's view
  bool sound = true;                      ///< where somebody is there to hear it: `mayHear`
  std::string camera, intrinsics, board;  ///< recorded pictures instead of the station's camera
  std::string expert_path;                ///< overrides the task's
  training::Role role = training::Role::scored;  ///< of the trials
  bool record_only = false;  ///< no expert path needed: trials that will make one
  std::string live;          ///< local socket where others may look on; empty: nobody
  std::string out;
  double rate_Hz = 1000;        ///< ticks a second
  int cpu = -1;                 ///< of the haptic thread; -1: any
  bool exact_geometry = false;  ///< from the full mesh in every tick
  bool quiet = false;
  int igtl_port = 0;                      ///< served by OpenIGTLink; 0: not
  std::string igtl_listen = "127.0.0.1";  ///< to whom: an address of this computer
  bool guidance = false;                  ///< palpation: help that fades, in every other trial
  bool see_through = false;               ///< palpation: the lumps are shown; not scored
  int tools = 1;                          ///< palpation: 2: fingers, each on a device of its own
  std::string surface;   ///< of what lies on the virtual bench; empty: the station's silicone
  std::string map;       ///< what it is like from place to place: a calibration of kind object
  bool show_map = true;  ///< palpation: it is drawn on the picture; not with `guidance`
  bool tracked_finger = false;  ///< palpation: the second is bare and tracked; its force estimated
  /// search: real, degraded, augmented, or all of them one after the other
  std::string mode = "real";
  bool sort = false;     ///< friction: several surfaces are put in order, in place of two compared
  bool blocks = false;   ///< search: the task's blocks; training in `mode`
  bool assess = false;   ///< assessment: every aid is off
  bool augment = false;  ///< needle, palpation: the task's augmentations add force
  StudyStep study;
  std::string uuid;    ///< of the session; empty: made when it begins
  bool report = true;  ///< report.html is made
  /// false: whoever holds it looks after it and begins it anew where its program dies; no note for
  /// `palpa finish`
  bool noted = true;
  LearnerOptions learner;
};

/// "person", "recorded", "novice", "custom", "learner", "expert".
const char* nameOf(OperatorKind who);

/// Of the simulated operator: the custom one's, or the shipped one's whose file's name begins so
/// ("", "palpation_", ...).
std::filesystem::path operatorFile(const SessionOptions& options, const std::string& engine);

/// What may be seen in it. As named; else in an assessment `assessed`; else practice, where no
/// force is felt without what replaces feeling.
presentation::Presentation shownIn(const SessionOptions& options);

/// Words on the picture that say what is not a person on a real station, and that the room is
/// filmed.
std::string markFor(const SessionOptions& options, const station::Station& station);

/// Whether a sound may be heard in it: in real time, by whoever sees it. Asked once it is settled.
bool mayHear(const SessionOptions& options);

/// What a session says of itself, with the study that it is part of, if any.
std::string sessionText(nlohmann::json session, const SessionOptions& options);

/// After parsing: what "auto" means here, and contradictions (UsageError).
void settle(SessionOptions& options);

/// With the station read: who can hold its device. Throws UsageError.
void settleOperator(SessionOptions& options, const station::Station& station);

}  // namespace palpa::session
