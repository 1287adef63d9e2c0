#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/record/store/study_store.h"
#include "apps/study/progress.h"

namespace palpa::study {

/// The experience of virtual trainees, in the records.
inline constexpr const char* kSimulatedExperience = "simulated";

/// What this station knows of somebody in a study, so that a session can go on while the records
/// cannot be reached.
struct StudyCopy {
  std::string protocol_sha256;
  record::Enrolment enrolment;
  std::vector<study::DoneTrial> trials;
  /// first those that the records have, their words left out here
  std::vector<record::ItemAnswer> answers;
  std::size_t sent = 0;  ///< how many those are
};

/// Beside the list of pending sessions; one file for study, trainee and records.
std::filesystem::path studyCopyFile(const std::string& study, const std::string& trainee,
                                    const std::string& url);

/// None where there is no file, or none that can be read: then the records are needed.
std::optional<StudyCopy> readStudyCopy(const std::filesystem::path& file);
void writeStudyCopy(const StudyCopy& copy,
                    const std::filesystem::path& file);  ///< beside, then renamed; throws Error
void removeStudyCopies(const std::string& trainee);      ///< of a person who is deleted

}  // namespace palpa::study
