#include "apps/record/store/delivery.h"

#include <algorithm>
#include <fstream>
#include <optional>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "apps/os/file_access.h"
#include "apps/runtime/clock.h"

namespace palpa::record {
namespace {

namespace fs = std::filesystem;
constexpr char kSuffix[] = ".pending";

}  // namespace

PendingHold::PendingHold(const fs::path& note)
    : lock_(os::FileLock::exclusive(note, os::FileLock::Missing::fails)) {}

PendingHold::~PendingHold() = default;

PendingList::PendingList(fs::path folder) : folder_(std::move(folder)) {}

fs::path PendingList::usualFolder() {
  return os::stateFolder("Set HOME, or XDG_STATE_HOME to a folder of yours") / "palpa/pending";
}

fs::path PendingList::noteOf(const std::string& uuid) const { return folder_ / (uuid + kSuffix); }

void PendingList::note(const PendingSession& session) {
  if (const std::error_code problem = os::makeFolders(folder_))
    failFile("cannot be made", folder_, problem, "Or set XDG_STATE_HOME to another folder");
  writeWhole(noteOf(session.uuid),
             fs::absolute(session.evidence).string() + "\n" + session.url + "\n");
}

std::vector<PendingSession> PendingList::sessions() const {
  std::vector<PendingSession> all;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder_, none)) {
    if (entry.path().extension() != kSuffix) continue;
    std::ifstream stream(entry.path());
    std::string evidence, url;
    if (std::getline(stream, evidence) && std::getline(stream, url) && !evidence.empty())
      all.push_back({entry.path().stem().string(), evidence, url});
  }
  std::sort(all.begin(), all.end(),
            [](const PendingSession& a, const PendingSession& b) { return a.uuid < b.uuid; });
  return all;
}

void PendingList::forget(const std::string& uuid) {
  std::error_code ignored;
  fs::remove(noteOf(uuid), ignored);
}

std::unique_ptr<PendingHold> PendingList::hold(const std::string& uuid) const {
  return std::make_unique<PendingHold>(noteOf(uuid));
}

bool PendingList::isHeld(const std::string& uuid) const { return os::isLocked(noteOf(uuid)); }

Delivered deliver(const std::string& url, const StoredSession& session,
                  const std::vector<StoredTrial>& trials, const Patience& patience) {
  Delivered delivered;
  std::optional<RecordStore> store;
  int tries = patience.tries;
  for (std::size_t i = 0; i < trials.size();) try {
      if (!store) store.emplace(url);
      (store->addTrial(session, trials[i]) ? delivered.added : delivered.present) += 1;
      ++i;
      tries = patience.tries;
    } catch (const StoreUnreachable&) {
      store.reset();
      if (--tries <= 0) throw;
      runtime::SteadyClock().sleepUntil(patience.pause_ns);
    }
  return delivered;
}

}  // namespace palpa::record
