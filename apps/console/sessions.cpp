#include "apps/console/sessions.h"

#include <algorithm>

#include "anatomy/base/error.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/whole_file.h"
#include "apps/console/jobs.h"
#include "apps/console/session_results.h"
#include "apps/os/file_access.h"

namespace palpa::console {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
constexpr char kFacts[] = "console.json", kLog[] = "log.txt", kTold[] = "told";

json factsOf(const fs::path& folder) {
  try {
    return JsonFile(folder / kFacts).json();
  } catch (const Error&) {
    return json::object();
  }
}

std::string textOf(const json& facts, const char* field) {
  return facts.value(field, json()).is_string() ? facts[field].get<std::string>() : "";
}

os::ProcessId processOf(const json& facts) {
  const auto number = [&](const char* field) {
    return facts.value(field, json()).is_number() ? facts[field].get<std::int64_t>() : 0;
  };
  return {static_cast<int>(number("pid")), static_cast<std::uint64_t>(number("began"))};
}

/// The session's own, or where a study put those of its blocks (TRAINEE/BLOCK).
std::vector<fs::path> recordsIn(const fs::path& folder) {
  constexpr int kDeepest = 2;
  constexpr char kEvidence[] = "session.palpa";
  std::error_code none;
  if (fs::exists(folder / kEvidence, none)) return {folder / kEvidence};
  std::vector<std::pair<fs::file_time_type, fs::path>> found;
  for (auto entry = fs::recursive_directory_iterator(folder, none);
       entry != fs::recursive_directory_iterator(); entry.increment(none)) {
    if (entry.depth() >= kDeepest || entry->path().filename() == "demonstration")
      entry.disable_recursion_pending();
    if (entry->path().filename() == kEvidence)
      found.emplace_back(entry->last_write_time(none), entry->path());
  }
  std::sort(found.begin(), found.end());
  std::vector<fs::path> records;
  for (auto& [written, record] : found) records.push_back(std::move(record));
  return records;
}

/// The newest folder with results.
fs::path resultsIn(const fs::path& folder) {
  const std::vector<fs::path> records = recordsIn(folder);
  return records.empty() ? folder : records.back().parent_path();
}

/// Of all that are kept, the oldest first.
std::vector<std::string> idsIn(const fs::path& sessions) {
  std::vector<std::string> ids;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(sessions, none))
    if (isId(entry.path().filename().string()) && fs::exists(entry.path() / kFacts, none))
      ids.push_back(entry.path().filename().string());
  std::sort(ids.begin(), ids.end());
  return ids;
}

json filesIn(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (entry.is_regular_file(none) && isShown(entry.path().filename().string()))
      names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// Why it ended as it did; empty: as it should.
std::string messageOf(const std::string& state, const fs::path& folder) {
  if (state != "failed" && state != "interrupted") return "";
  std::string complaint = complaintIn(folder / kLog);
  if (!complaint.empty()) return complaint;
  return state == "failed" ? "The session ended before it had started and left no message: its "
                             "program or the computer was stopped. Start it again"
                           : "The session ended and left no message: its program or the computer "
                             "was stopped. What was recorded until then is kept";
}

}  // namespace

Sessions::Sessions(const ConsolePlace& place) : place_(place) {
  os::makeFolders(place_.sessions());  // whoever starts a session meets what is wrong
  find();
}

std::string Sessions::socketOf(const std::string& id) const {
  return place_.sockets + "/" + id.substr(id.size() > 24 ? id.size() - 24 : 0) + ".sock";
}

fs::path Sessions::folder(const std::string& id) const {
  if (!has(id))
    throw UsageError("is not here", "session " + id.substr(0, 64), "Choose one from the list");
  return place_.sessions() / id;
}

fs::path Sessions::results(const std::string& id) const { return resultsIn(folder(id)); }

bool Sessions::isBlind(const std::string& id) const {
  return factsOf(folder(id)).value("blind", false);
}

fs::path Sessions::shown(const std::string& id) const {
  if (isBlind(id))
    throw UsageError("belongs to a study whose educators are blinded", "session " + id,
                     "Its figures are read when the study is: palpa study analyse");
  return results(id);
}

/// Those that went on while there was no console.
void Sessions::find() {
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(place_.sessions(), none)) {
    std::string id = entry.path().filename().string();
    const os::ProcessId process = processOf(factsOf(entry.path()));
    if (isId(id) && os::runs(process)) connect(id, process);
  }
}

void Sessions::connect(const std::string& id, os::ProcessId process) {
  auto link = std::make_shared<SessionLink>(socketOf(id), isBlind(id));
  running_[id] = {process, link, false};
  const std::lock_guard lock(links_mutex_);
  links_[id] = std::move(link);
}

std::string Sessions::begin(const SessionWish& wish, std::vector<std::string> arguments) {
  look();
  const std::lock_guard lock(mutex_);
  if (std::any_of(running_.begin(), running_.end(),
                  [](const auto& one) { return !one.second.over; }))
    throw UsageError("one is running already", "a new session cannot start",
                     "End it first, or wait until it is over");
  std::string id = newId();
  fs::path folder = place_.sessions() / id;
  if (const std::error_code problem = os::makeFolders(folder))
    failFile("cannot be made", folder, problem);
  for (const std::string& more :
       {std::string("--live"), socketOf(id), std::string("--out"), folder.string()})
    arguments.push_back(more);
  json facts{{"performer", wish.performer},
             {"task", wish.task},
             {"title", wish.title},
             {"trainee", wish.trainee},
             {"started_utc", utcNow()},
             {"assessed", wish.assess},
             {"filmed", wish.film},
             {"simulated", wish.simulated},
             {"study", !wish.protocol.empty()},
             {"blind", wish.blind},
             {"trials", wish.trials}};
  writeWhole(folder / kFacts, facts.dump(1) + "\n");
  const os::ProcessId process = starter_.start(arguments, folder / kLog);
  facts["pid"] = process.pid;
  facts["began"] = process.began;
  writeWhole(folder / kFacts, facts.dump(1) + "\n");
  connect(id, process);
  return id;
}

void Sessions::look() {
  const std::lock_guard lock(mutex_);
  for (auto& [id, one] : running_) {
    if (one.over || os::runs(one.process)) continue;
    one.over = true;
    const fs::path folder = place_.sessions() / id;
    const std::string state = stateOf(id, folder);
    one.link->close(
        json{{"kind", "end"}, {"state", state}, {"message", messageOf(state, folder)}}.dump(
            -1, ' ', false, json::error_handler_t::replace));
  }
}

/// With the mutex held, or of a session that does not run.
std::string Sessions::stateOf(const std::string& id, const fs::path& folder) {
  if (const auto found = running_.find(id); found != running_.end() && !found->second.over)
    return found->second.link->hasReported() ? "running" : "starting";
  std::error_code none;
  const fs::path results = resultsIn(folder);
  if (fs::exists(results / "report.html", none)) return "finished";
  return fs::exists(results / "session.palpa", none) ? "interrupted" : "failed";
}

json Sessions::described(const std::string& id, const fs::path& folder) {
  const json facts = factsOf(folder);
  const std::string state = stateOf(id, folder);
  json one{{"id", id},
           {"task", textOf(facts, "task")},
           {"title", textOf(facts, "title")},
           {"trainee", textOf(facts, "trainee")},
           {"started_utc", textOf(facts, "started_utc")},
           {"state", state},
           {"message", messageOf(state, folder)}};
  for (const char* field :
       {"assessed", "filmed", "performer", "simulated", "trials", "study", "blind"})
    one[field] = facts.value(field, json());
  return one;
}

/// What came of one that is over, kept with its facts: a list is asked for every few seconds. Of a
/// blind one nothing.
json Sessions::outcomeIn(const fs::path& folder, const json& described, int* read) {
  json facts = factsOf(folder);
  if (described["state"] != "finished" || described["blind"] == true) return nullptr;
  if (facts.contains("outcome") && facts["outcome"].contains("word")) return facts["outcome"];
  if (--*read < 0) return nullptr;  // the next time
  try {
    facts["outcome"] = outcomeOf(trialsIn(resultsIn(folder) / "session.palpa", false));
    writeWhole(folder / kFacts, facts.dump(1) + "\n");
  } catch (const Error&) {  // damaged, or no room: its own page says so
    return nullptr;
  }
  return facts["outcome"];
}

json Sessions::list() {
  constexpr int kReadAtOnce = 4;
  look();
  const std::lock_guard lock(mutex_);
  std::vector<std::string> ids = idsIn(place_.sessions());
  std::reverse(ids.begin(), ids.end());
  json all = json::array();
  int read = kReadAtOnce;
  for (const std::string& id : ids) {
    const fs::path folder = place_.sessions() / id;
    json one = described(id, folder);
    one["outcome"] = outcomeIn(folder, one, &read);
    all.push_back(std::move(one));
  }
  return all;
}

json Sessions::one(const std::string& id) {
  const fs::path here = folder(id);
  look();
  json one;
  {
    const std::lock_guard lock(mutex_);
    one = described(id, here);
  }
  const fs::path results = resultsIn(here);
  const bool blind = one["blind"] == true;
  one["files"] = blind ? json::array() : filesIn(results);
  std::error_code none;
  one["film"] = !blind && fs::exists(results / "room.mjpeg", none);
  one["results"] = json::array();
  if (one["state"] == "running" || one["state"] == "starting")
    return one;  // its evidence is being written
  try {
    one["results"] = trialsIn(results / "session.palpa", blind);
  } catch (const Error& e) {
    one["message"] = e.what();
  }
  return one;
}

std::shared_ptr<SessionLink> Sessions::link(const std::string& id) {
  look();
  const std::lock_guard lock(mutex_);
  const auto found = running_.find(id);
  return found == running_.end() ? nullptr : found->second.link;
}

std::shared_ptr<SessionLink> Sessions::linkForStop(const std::string& id) const {
  const std::lock_guard lock(links_mutex_);
  const auto found = links_.find(id);
  return found == links_.end() ? nullptr : found->second;
}

std::string Sessions::running() {
  look();
  const std::lock_guard lock(mutex_);
  for (const auto& [id, one] : running_)
    if (!one.over) return id;
  return "";
}

std::string Sessions::firstUntold(std::set<std::string>* done) {
  const std::string on = running();
  for (std::string& id : idsIn(place_.sessions())) {
    if (id == on || done->contains(id)) continue;
    if (!factsOf(place_.sessions() / id).value(kTold, false)) return std::move(id);
    done->insert(std::move(id));
  }
  return "";
}

/// Facts that cannot be read are left as they are: they say who was trained, and whether blind.
void Sessions::markTold(const std::string& id) {
  const std::lock_guard lock(mutex_);
  json facts = factsOf(folder(id));
  if (facts.empty()) return;
  facts[kTold] = true;
  writeWhole(folder(id) / kFacts, facts.dump(1) + "\n");
}

bool Sessions::has(const std::string& id) const {
  std::error_code none;
  return isId(id) && fs::is_regular_file(place_.sessions() / id / kFacts, none);
}

std::string Sessions::startOf(const std::string& id) const {
  std::string utc = textOf(factsOf(folder(id)), "started_utc");
  if (utc.empty()) throw Error("does not say when it began", "session " + id, "Look at its folder");
  return utc;
}

std::vector<fs::path> Sessions::records(const std::string& id) const {
  return recordsIn(folder(id));
}

}  // namespace palpa::console
