#include "apps/record/store/delivery.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "apps/runtime/clock.h"

namespace palpa::record {
namespace {

namespace fs = std::filesystem;
constexpr char kSuffix[] = ".pending";

}  // namespace

PendingHold::PendingHold(const fs::path& note)
    : descriptor_(::open(note.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (descriptor_ >= 0) ::flock(descriptor_, LOCK_EX | LOCK_NB);
}

PendingHold::~PendingHold() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

PendingList::PendingList(fs::path folder) : folder_(std::move(folder)) {}

fs::path PendingList::usualFolder() {
  if (const char* state = std::getenv("XDG_STATE_HOME"); state && *state == '/')
    return fs::path(state) / "palpa/pending";
  const char* home = std::getenv("HOME");
  return fs::path(home && *home ? home : "/tmp") / ".local/state/palpa/pending";
}

fs::path PendingList::noteOf(const std::string& uuid) const { return folder_ / (uuid + kSuffix); }

void PendingList::note(const PendingSession& session) {
  std::error_code problem;
  fs::create_directories(folder_, problem);
  if (problem)
    throw Error("cannot be made (" + problem.message() + ")", folder_.string(),
                "Make it writable, or set XDG_STATE_HOME to another folder");
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

bool PendingList::isHeld(const std::string& uuid) const {
  const int descriptor = ::open(noteOf(uuid).c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool held = ::flock(descriptor, LOCK_SH | LOCK_NB) != 0;
  ::close(descriptor);
  return held;
}

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
