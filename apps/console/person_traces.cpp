#include "apps/console/person_traces.h"

#include <nlohmann/json.hpp>
#include <sstream>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/whole_file.h"
#include "apps/console/place.h"
#include "apps/learning/launches.h"
#include "apps/record/store/record_store.h"

namespace palpa::console {
namespace {

namespace fs = std::filesystem;

ConsolePlace placeAt(const fs::path& home) {
  ConsolePlace place;
  place.home = home;
  return place;
}

bool isOfTrainee(const fs::path& session, const std::string& trainee) {
  const auto text = readWhole(session / "console.json");
  const nlohmann::json facts = parsedOrDiscarded(text.value_or(""));
  return facts.is_object() && facts.value("trainee", nlohmann::json()) == trainee;
}

bool anyFileMentions(const fs::path& folder, const std::string& trainee) {
  std::error_code none;
  for (auto entry = fs::recursive_directory_iterator(folder, none);
       entry != fs::recursive_directory_iterator(); entry.increment(none)) {
    if (!entry->is_regular_file(none)) continue;
    const auto text = readWhole(entry->path());
    if (text && record::mentions(*text, trainee)) return true;
  }
  return false;
}

/// True: it is gone with all that is in it.
bool removeWhole(const fs::path& path, PersonTraces* traces) {
  std::error_code problem;
  fs::remove_all(path, problem);
  if (problem)
    traces->troubles.push_back(path.string() + ": cannot be removed (" +
                               fileTrouble(problem.value()).why +
                               "). Make its folder writable, or delete it by hand");
  return !problem;
}

void removeLines(const fs::path& log, const std::string& trainee, PersonTraces* traces) {
  const auto text = readWhole(log);
  if (!text || !record::mentions(*text, trainee)) return;
  std::istringstream lines(*text);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    if (record::mentions(line, trainee))
      ++traces->lines;
    else
      kept += line + "\n";
  }
  try {
    writeWhole(log, kept);
  } catch (const Error& e) {
    traces->troubles.emplace_back(e.what());
  }
}

}  // namespace

std::vector<fs::path> sessionsOf(const fs::path& home, const std::string& trainee) {
  std::vector<fs::path> theirs = entriesOf(placeAt(home).sessions());
  std::erase_if(theirs, [&](const fs::path& session) { return !isOfTrainee(session, trainee); });
  return theirs;
}

void removeSessionTraces(const fs::path& folder, PersonTraces* traces) {
  for (const fs::path& entry : entriesOf(folder)) {
    const std::string name = entry.filename().string();
    if (name == "console.json" || name == "log.txt" || name.starts_with("replay-") ||
        name.starts_with("room.mjpeg"))
      removeWhole(entry, traces);
  }
  std::error_code none;
  if (fs::is_empty(folder, none) && !none) removeWhole(folder, traces);
  ++traces->sessions;
}

void removeHomeTraces(const fs::path& home, const std::string& trainee, PersonTraces* traces) {
  for (const fs::path& job : entriesOf(placeAt(home).jobs()))
    if (isId(job.filename().string()) && anyFileMentions(job, trainee))
      traces->jobs += removeWhole(job, traces) ? 1 : 0;
  for (const fs::path& log : entriesOf(home))
    if (log.filename().string().find(".log") != std::string::npos)
      removeLines(log, trainee, traces);
  traces->launches += static_cast<std::size_t>(
      learning::Launches(learning::Folder(home).launches()).forget(trainee));
}

}  // namespace palpa::console
