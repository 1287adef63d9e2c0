#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "anatomy/parametric/parametric_patient.h"
#include "anatomy/patient.h"
#include "anatomy/query/local_geometry_builder.h"
#include "anatomy/query/surface_query.h"
#include "apps/record/session_file.h"
#include "apps/session/session_devices.h"
#include "apps/session/session_facts.h"
#include "apps/session/session_options.h"
#include "apps/station/material_files.h"
#include "apps/station/station_file.h"
#include "apps/task_needle/needle_task.h"
#include "apps/task_needle/task_file.h"
#include "apps/training/trial_words.h"
#include "apps/twin/operator.h"
#include "calibration/expert_path.h"

namespace palpa::session {

/// Everything a needle session rests on, read and checked before anything starts. Immovable: parts
/// refer to each other.
struct NeedleWorld {
  explicit NeedleWorld(const SessionOptions& options);  ///< throws UsageError / Error
  NeedleWorld(const NeedleWorld&) = delete;
  NeedleWorld& operator=(const NeedleWorld&) = delete;

  station::Station station;
  task_needle::TaskSettings task;
  station::NeedleFile needle;
  anatomy::Patient patient;
  anatomy::SurfaceQuery query;
  anatomy::LocalGeometryBuilder geometry;
  std::optional<anatomy::LandmarkFrame> landmarks;  ///< none: it is no patient
  std::optional<calibration::ExpertPath> expert_path;
  std::optional<calibration::TaughtPath> taught_path;  ///< the same on this patient
  std::string not_scored;  ///< why no score can be given on this patient: no path then
  std::vector<anatomy::TriangleMesh> real_things;  ///< the station's, in its order; metres
  Pose X_WA, X_DA;

  haptics::TickConfig tickConfig() const;
  /// What cues of the task may lead along and keep out of: the taught line of the second phase, and
  /// balls on the organs that the task names. Empty where no path is taught here.
  task_needle::NeedleFixtures fixtures() const;
  /// What a simulated operator knows: the landmarks, and where the vein lies in the mean anatomy
  /// or, where he has studied this patient's images, in the patient as he is shown.
  twin::VisibleAnatomy visible(const twin::OperatorSkill& skill, bool knows_patient) const;
  /// A trial with this seed's skin and walls.
  task_needle::TrialPlan trial(training::Role role, std::uint64_t seed, bool force_feedback,
                               bool augmented) const;
};

/// Who may hold the needle: a simulated operator, as the options ask for one, or somebody with a
/// mouse.
SessionDevices::Hands needleHands(const SessionOptions& options, const NeedleWorld& world);

/// Whether anything in the session is simulated: the operator, or what is seen and felt.
bool isSimulated(const SessionOptions& options, const NeedleWorld& world);

/// What the loop runs with: materials, safety, coupling, rate; what the device and whoever holds it
/// can do.
haptics::TickConfig tickConfig(const SessionOptions& options, const NeedleWorld& world);

/// What its report says before the first trial.
ReportHead headOf(const SessionOptions& options, const NeedleWorld& world);

/// What the evidence says of the session.
record::SessionInfo sessionInfo(const SessionOptions& options, const NeedleWorld& world);

/// The patient that `anatomy::buildPatient` makes of these parameters, the same to the bit. One
/// that is built is kept, and an earlier run's is read: two seconds less for every session. Kept in
/// "patients" in the folder that $PALPA_CACHE names ("off": nowhere), else in palpa in this user's
/// folder of caches; readable by the user alone. The file's name is the SHA-256 of this very
/// program (its place, size and age) and of the parameters; its first line is that of the rest, so
/// what is damaged is built anew. Throws Error as `buildPatient` does; a folder that cannot be read
/// or written is no error. Any number of programs may share it, and it may be emptied at any time.
/// Only drawn people are kept: an imported patient is somebody, and is read from the file that was
/// named.
anatomy::Patient keptPatient(const anatomy::PatientParameters& parameters);

/// Some seventy patients.
inline constexpr std::uintmax_t kMostKept_bytes = 512u << 20;
/// Removes the oldest kept patients, and what programs could not finish, until no more bytes are
/// left in the folder. Other files stay. What another program removes meanwhile is no error.
void boundKept(const std::filesystem::path& folder, std::uintmax_t most_bytes);

}  // namespace palpa::session
