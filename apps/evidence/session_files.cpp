#include "apps/evidence/session_files.h"

#include <algorithm>
#include <string_view>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/whole_file.h"
#include "apps/record/session_file.h"
#include "apps/record/store/record_store.h"

namespace palpa::evidence {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEvidenceName = "session.palpa";
constexpr const char* kBesideDatabases[] = {"", "-wal", "-shm", "-journal"};
constexpr std::string_view kTexts[] = {"report.html", "trials.csv", "trial.html"};
constexpr std::string_view kOthers[] = {"registration.csv", "camera.mjpeg", "camera.mjpeg.csv",
                                        "room.mjpeg", "room.mjpeg.csv"};
constexpr std::string_view kPages[] = {"trainee.html", "cohort.html"};

template <std::size_t n>
bool isOneOf(const std::string_view (&names)[n], std::string_view name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

/// A name that a session gives to what it leaves; unfinished, too.
bool isSessionsOwn(std::string_view name) {
  if (name.ends_with(".part")) name.remove_suffix(5);
  const bool picture = name.starts_with("view-") && name.ends_with(".png");
  const bool rated = (name.starts_with("rating-") && name.ends_with(".csv")) ||
                     (name.starts_with("exam-") && name.ends_with(".html")) ||
                     (name.starts_with("certificate-") && name.ends_with(".pdf"));
  return picture || rated || isOneOf(kTexts, name) || isOneOf(kOthers, name);
}

bool namesTrainee(const fs::path& file, const std::string& trainee) {
  const auto text = readWhole(file);
  return text && !trainee.empty() && record::mentions(*text, trainee, true);
}

/// True: it was there, and is gone.
bool removeFile(const fs::path& file, std::vector<std::string>* troubles) {
  std::error_code problem;
  if (fs::remove(file, problem)) return true;
  if (problem)
    troubles->push_back(file.string() + ": cannot be removed (" + fileTrouble(problem.value()).why +
                        "). Make its folder writable");
  return false;
}

void removeIfEmpty(const fs::path& folder, std::vector<std::string>* troubles) {
  std::error_code none;
  if (fs::is_directory(fs::symlink_status(folder, none)) && fs::is_empty(folder, none))
    removeFile(folder, troubles);
}

void removeEvidence(const fs::path& evidence, SessionRemoval* removal) {
  for (const char* beside : kBesideDatabases)
    removal->files += removeFile(evidence.string() + beside, &removal->troubles) ? 1 : 0;
}

/// The expert's session, shown before a trainee's first trial: all of it belongs to this one.
void removeDemonstration(const fs::path& folder, SessionRemoval* removal) {
  removeEvidence(folder / kEvidenceName, removal);
  for (const fs::path& file : entriesOf(folder))
    if (isSessionsOwn(file.filename().string()))
      removal->files += removeFile(file, &removal->troubles) ? 1 : 0;
  removeIfEmpty(folder, &removal->troubles);
}

void removeBeside(const fs::path& folder, const EvidenceOwner& owner, bool owned,
                  SessionRemoval* removal) {
  for (const fs::path& file : entriesOf(folder)) {
    const std::string name = file.filename().string();
    std::error_code none;
    if (owned && name == "demonstration" && fs::is_directory(fs::symlink_status(file, none)))
      removeDemonstration(file, removal);
    else if (isSessionsOwn(name) &&
             (owned || (isOneOf(kTexts, name) && namesTrainee(file, owner.trainee))))
      removal->files += removeFile(file, &removal->troubles) ? 1 : 0;
  }
}

bool hasTextOf(const fs::path& folder, const std::string& trainee) {
  const std::vector<fs::path> files = entriesOf(folder);
  return std::any_of(files.begin(), files.end(), [&](const fs::path& file) {
    return isOneOf(kTexts, file.filename().string()) && namesTrainee(file, trainee);
  });
}

/// A block of a study lies in the trainee's own folder, TRAINEE/BLOCK.
void removeFolders(const fs::path& folder, const std::string& trainee, SessionRemoval* removal) {
  if (removal->troubles.empty()) removal->kept = entriesOf(folder);
  removeIfEmpty(folder, &removal->troubles);
  if (!trainee.empty() && folder.parent_path().filename() == trainee)
    removeIfEmpty(folder.parent_path(), &removal->troubles);
}

RemovalEnd endOf(const fs::path& evidence, const EvidenceOwner& found, const EvidenceOwner& owner) {
  std::error_code none;
  if (!fs::exists(evidence, none)) return RemovalEnd::absent;
  if (found.uuid.empty()) return RemovalEnd::unreadable;
  return found.uuid == owner.uuid ? RemovalEnd::removed : RemovalEnd::another;
}

}  // namespace

EvidenceOwner ownerOf(const fs::path& evidence) {
  try {
    const record::SessionReader reader(evidence);
    const record::SessionInfo& info = reader.info();
    const nlohmann::json facts = parsedOrDiscarded(info.session_json);
    const bool named = facts.is_object() && facts.value("trainee", nlohmann::json()).is_string();
    return {info.uuid, named ? facts["trainee"].get<std::string>() : ""};
  } catch (const Error&) {  // not here, or not to be read
    return {};
  }
}

SessionRemoval removeSession(const fs::path& evidence, const EvidenceOwner& owner) {
  SessionRemoval removal;
  removal.end = endOf(evidence, ownerOf(evidence), owner);
  const fs::path folder = evidence.parent_path();
  const bool has_folder = evidence.filename() == kEvidenceName;  // else it is somebody's
  // Its evidence was deleted by hand before, and nothing else
  if (removal.end == RemovalEnd::absent && has_folder && hasTextOf(folder, owner.trainee))
    removal.end = RemovalEnd::removed;
  const bool owned = removal.end == RemovalEnd::removed;
  if (has_folder) removeBeside(folder, owner, owned, &removal);
  // Last: as long as something else is left, it says whose that is
  if (owned && removal.troubles.empty()) removeEvidence(evidence, &removal);
  if (owned && has_folder) removeFolders(folder, owner.trainee, &removal);
  return removal;
}

std::vector<fs::path> removePracticePages(const fs::path& folder, const std::string& trainee,
                                          std::vector<std::string>* troubles) {
  std::vector<fs::path> removed;
  std::error_code none;
  for (const fs::path& place : entriesOf(folder)) {
    if (!fs::is_directory(fs::symlink_status(place, none))) continue;
    for (const std::string_view page : kPages) {
      const fs::path file = place / page;
      if (fs::is_regular_file(fs::symlink_status(file, none)) && namesTrainee(file, trainee) &&
          removeFile(file, troubles))
        removed.push_back(file);
    }
    if (!removed.empty() && removed.back().parent_path() == place) removeIfEmpty(place, troubles);
  }
  return removed;
}

}  // namespace palpa::evidence
