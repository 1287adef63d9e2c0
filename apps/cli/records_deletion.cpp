#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "apps/cli/arguments.h"
#include "apps/cli/records_actions.h"
#include "apps/console/person_traces.h"
#include "apps/evidence/evidence_records.h"
#include "apps/evidence/session_files.h"
#include "apps/link/outbox.h"
#include "apps/runtime/clock.h"
#include "apps/session/finish_session.h"
#include "apps/study/run/participant.h"

namespace palpa::cli {
namespace {

namespace fs = std::filesystem;
using evidence::EvidenceOwner;
using evidence::RemovalEnd;

bool liesIn(const fs::path& file, const fs::path& folder) {
  return file.string().starts_with(folder.string() + "/");
}

/// Evidence of a trainee's sessions in a folder and those in it.
std::vector<std::pair<fs::path, EvidenceOwner>> evidenceIn(const fs::path& folder,
                                                           const std::string& trainee) {
  std::vector<std::pair<fs::path, EvidenceOwner>> all;
  std::error_code none;
  for (auto entry = fs::recursive_directory_iterator(folder, none);
       entry != fs::recursive_directory_iterator(); entry.increment(none)) {
    if (entry->path().filename() != "session.palpa") continue;
    if (EvidenceOwner owner = evidence::ownerOf(entry->path()); owner.trainee == trainee)
      all.emplace_back(entry->path(), std::move(owner));
  }
  return all;
}

/// One run of the command: what it deletes, and what it has to leave.
class Deletion {
 public:
  Deletion(record::RecordStore& store, const RecordsOptions& o)
      : store_(store),
        records_(evidence::absoluteRecords(o.url)),
        home_(fs::absolute(o.home.empty() ? usualConsoleHome() : fs::path(o.home))
                  .lexically_normal()),
        home_is_theirs_(!o.home.empty() || records_ == evidence::absoluteRecords(usualRecords())) {}

  void person(const std::string& id);
  void leftOfOthers();
  void finish();  ///< throws Error where something is left

 private:
  void removeEvidence(const fs::path& file, const EvidenceOwner& owner);
  void removePending(const std::string& id);
  void removeFromConsole(const std::string& id, bool whole);
  void removePages(const std::string& id);
  void sayWhatIsKept();
  void takeBack();
  std::size_t sayWhatIsLeft();

  record::RecordStore& store_;
  const std::string records_;
  const fs::path home_;
  const bool home_is_theirs_;       ///< the console's; it may keep other records' people
  std::set<std::string> sessions_;  ///< of this run
  std::set<fs::path> places_;       ///< where evidence of this run was
  std::map<std::string, std::string> reasons_;  ///< why a session's evidence stayed
  std::vector<std::string> troubles_;
  std::vector<fs::path> kept_;
};

void Deletion::removeEvidence(const fs::path& file, const EvidenceOwner& owner) {
  sessions_.insert(owner.uuid);
  const evidence::SessionRemoval removal = evidence::removeSession(file, owner);
  troubles_.insert(troubles_.end(), removal.troubles.begin(), removal.troubles.end());
  kept_.insert(kept_.end(), removal.kept.begin(), removal.kept.end());
  if (removal.end == RemovalEnd::another)
    reasons_[owner.uuid] = "another session's evidence is in its place";
  if (removal.end == RemovalEnd::unreadable)
    reasons_[owner.uuid] = "it cannot be read: delete its folder by hand";
  if (removal.end != RemovalEnd::removed) return;
  places_.insert(file);
  if (!removal.troubles.empty()) return;
  store_.evidenceDeleted(owner.uuid);
  std::printf("Deleted: %s (%s)\n", file.c_str(), counted(removal.files, "file").c_str());
}

/// What was recorded for these records and never reached them.
void Deletion::removePending(const std::string& id) {
  record::PendingList pending(record::PendingList::usualFolder());
  for (const record::PendingSession& waiting : pending.sessions()) {
    if (waiting.url != records_) continue;
    const EvidenceOwner owner = evidence::ownerOf(waiting.evidence);
    if (!sessions_.contains(waiting.uuid) && owner.trainee != id) continue;
    if (owner.trainee == id) removeEvidence(waiting.evidence, owner);
    pending.forget(waiting.uuid);
  }
}

/// `whole`: every session that was begun there under this name.
void Deletion::removeFromConsole(const std::string& id, bool whole) {
  console::PersonTraces traces;
  for (const fs::path& session : console::sessionsOf(home_, id)) {
    if (whole && home_is_theirs_)
      for (const auto& [file, owner] : evidenceIn(session, id)) removeEvidence(file, owner);
    const bool emptied = std::any_of(places_.begin(), places_.end(),
                                     [&](const fs::path& file) { return liesIn(file, session); });
    if (emptied || (whole && home_is_theirs_)) console::removeSessionTraces(session, &traces);
  }
  if (home_is_theirs_) console::removeHomeTraces(home_, id, &traces);
  troubles_.insert(troubles_.end(), traces.troubles.begin(), traces.troubles.end());
  if (traces.sessions + traces.jobs + traces.lines > 0)
    std::printf("Deleted from the console: %s, %s, %s of its logs\n",
                counted(traces.sessions, "session").c_str(), counted(traces.jobs, "job").c_str(),
                counted(traces.lines, "line").c_str());
  if (traces.launches > 0)
    std::printf("Deleted: what was kept of %s that a learning management system launched\n",
                counted(traces.launches, "session").c_str());
}

/// Beside the sessions' folders, and where reports go unless --out says otherwise.
void Deletion::removePages(const std::string& id) {
  std::set<fs::path> folders{fs::absolute("out")};
  for (const fs::path& file : places_) folders.insert(file.parent_path().parent_path());
  for (const fs::path& folder : folders)
    for (const fs::path& page : evidence::removePracticePages(folder, id, &troubles_))
      std::printf("Deleted: %s, which can be made again\n", page.c_str());
}

void Deletion::person(const std::string& id) {
  study::removeStudyCopies(id);
  const std::vector<record::StoredSession> sessions = store_.deletePerson(id, runtime::utcNow());
  for (const record::StoredSession& session : sessions)
    removeEvidence(session.evidence, {session.uuid, id});
  removePending(id);
  removeFromConsole(id, true);
  removePages(id);
  std::printf("Trainee %s and %s deleted; what was recorded before is refused from now on\n",
              id.c_str(), counted(sessions.size(), "session").c_str());
}

/// The name is known from the evidence alone; it may have been given anew since.
void Deletion::leftOfOthers() {
  for (const record::StoredSession& session : store_.evidenceToDelete()) {
    const EvidenceOwner owner = evidence::ownerOf(session.evidence);
    const std::string id = owner.uuid == session.uuid ? owner.trainee : "";
    removeEvidence(session.evidence, {session.uuid, id});
    if (id.empty()) continue;
    removeFromConsole(id, false);
    removePages(id);
  }
}

void Deletion::sayWhatIsKept() {
  std::error_code none;
  for (const fs::path& file : kept_)
    if (fs::exists(file, none)) std::printf("Kept, since no session wrote it: %s\n", file.c_str());
}

/// What learning record stores were told of a deleted person is to be taken back.
void Deletion::takeBack() {
  if (!fs::exists(link::Outbox::usualFile())) return;
  link::Outbox outbox(link::Outbox::usualFile());
  for (const std::string& endpoint : outbox.endpoints(records_))
    if (const int count = link::takeBackDeleted(store_, {endpoint, records_}, outbox); count > 0)
      std::printf("%s will be taken back there by: palpa records xapi --to %s\n",
                  counted(count, "statement").c_str(), endpoint.c_str());
}

/// Of all deletions; returns how many of this run's.
std::size_t Deletion::sayWhatIsLeft() {
  std::size_t ours = 0;
  const std::vector<record::StoredSession> left = store_.evidenceToDelete();
  for (const record::StoredSession& session : left) {
    const auto reason = reasons_.find(session.uuid);
    std::printf("Still to be deleted where it was made: %s (session %s)%s%s\n",
                session.evidence.c_str(), session.uuid.c_str(),
                reason == reasons_.end() ? "" : ": ",
                reason == reasons_.end() ? "" : reason->second.c_str());
    ours += sessions_.contains(session.uuid) ? 1 : 0;
  }
  if (!left.empty())
    std::printf(
        "On the computer that has it: palpa records delete --left. Where it is gone already: palpa "
        "records delete --forget UUID\n");
  return ours;
}

void Deletion::finish() {
  sayWhatIsKept();
  takeBack();
  session::unfinishedSessions();  // forgets, with their paths, those that are gone
  for (std::string& trouble : store_.settleDeletions()) troubles_.push_back(std::move(trouble));
  for (const std::string& trouble : troubles_) std::printf("Not deleted: %s\n", trouble.c_str());
  if (const std::size_t left = sayWhatIsLeft(); left + troubles_.size() > 0)
    throw Error("could not be deleted: see above", counted(left + troubles_.size(), "thing"),
                "Everything else is; correct what is named, then: palpa records delete --left");
}

void requireNoneRuns(const RecordsOptions& o, const std::vector<std::string>& ids) {
  const record::PendingList pending(record::PendingList::usualFolder());
  for (const record::PendingSession& waiting : pending.sessions()) {
    if (waiting.url != evidence::absoluteRecords(o.url) || !pending.isHeld(waiting.uuid)) continue;
    const std::string trainee = evidence::ownerOf(waiting.evidence).trainee;
    if (std::find(ids.begin(), ids.end(), trainee) != ids.end())
      throw UsageError("is in a session that is still going on", "trainee " + trainee,
                       "End the session first; nothing was deleted");
  }
}

}  // namespace

void deletePeople(record::RecordStore& store, const RecordsOptions& o,
                  const std::vector<std::string>& ids) {
  requireNoneRuns(o, ids);
  Deletion deletion(store, o);
  for (const std::string& id : ids) deletion.person(id);
  deletion.finish();
}

void deleteLeft(record::RecordStore& store, const RecordsOptions& o) {
  Deletion deletion(store, o);
  deletion.leftOfOthers();
  deletion.finish();
}

void forgetLeft(record::RecordStore& store, const std::string& session) {
  const std::vector<record::StoredSession> left = store.evidenceToDelete();
  if (std::none_of(left.begin(), left.end(),
                   [&](const record::StoredSession& s) { return s.uuid == session; }))
    throw UsageError("is not among what is still to be deleted", "session " + session,
                     "palpa records delete --left names them");
  store.evidenceDeleted(session);
  store.settleDeletions();
  std::printf("Forgotten: session %s\n", session.c_str());
}

}  // namespace palpa::cli
