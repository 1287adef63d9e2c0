
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "apps/cli/arguments.h"
#include "apps/cli/records_actions.h"
#include "apps/evidence/evidence_records.h"
#include "apps/link/data_tables.h"
#include "apps/link/outbox.h"
#include "apps/link/statement.h"
#include "apps/os/child_process.h"
#include "apps/os/file_access.h"
#include "apps/record/store/migrations.h"
#include "apps/session/output_folder.h"

namespace palpa::cli {
namespace {

namespace fs = std::filesystem;

/// A file that is gone at the end, with what SQLite keeps beside it.
class PassingFile {
 public:
  explicit PassingFile(fs::path path) : path_(std::move(path)) {}
  ~PassingFile() {
    for (const char* beside : {"", "-wal", "-shm", "-journal"}) {
      std::error_code ignored;
      fs::remove(path_.string() + beside, ignored);
    }
  }
  PassingFile(const PassingFile&) = delete;
  PassingFile& operator=(const PassingFile&) = delete;
  std::string name() const { return path_.string(); }

 private:
  fs::path path_;
};

std::size_t copied(const std::string& from, const std::string& to) {
  return record::copyStore(*record::connect(from), *record::connect(to));
}

}  // namespace

/// Written beside and renamed: a backup is there whole or not at all.
void backUpRecords(const RecordsOptions& o) {
  requireRecords(o.url);
  if (record::isServer(o.out))
    throw UsageError("is a server; a backup is a file", "--out",
                     "Give a file; palpa records restore brings it to a server");
  if (fs::exists(o.out))
    throw UsageError("already exists, and a backup never overwrites", o.out,
                     "Give another name, such as one with today's date");
  const std::string part = o.out + "." + std::to_string(os::processNumber()) + ".part";
  if (const std::error_code problem = os::createNew(part))
    failFile("cannot be written", o.out, problem);
  const PassingFile beside(part);
  { const record::RecordStore opened(o.url); }  // deletes again who came back with a backup
  const std::size_t rows = copied(o.url, beside.name());
  std::error_code problem;
  fs::rename(beside.name(), o.out, problem);
  if (problem) failFile("cannot be written", o.out, problem);
  std::printf("Written: %s, %s\n", o.out.c_str(), counted(rows, "row").c_str());
}

/// From a copy, so that the backup stays as it is, even on a medium that cannot be written. Whoever
/// was deleted since it was made is deleted again.
void restoreRecords(const RecordsOptions& o) {
  if (!fs::is_regular_file(o.from))
    throw UsageError("is not a file", o.from, "Give a backup that palpa records backup wrote");
  requireRecords(o.from);
  const os::TemporaryFolder folder("palpa-restore-");
  if (!folder.made())
    throw Error("cannot be made", folder.path().string(), "Free space there, or set TMPDIR");
  const PassingFile copy(folder.path() / fs::path(o.from).filename());
  std::error_code problem;
  fs::copy_file(o.from, copy.name(), fs::copy_options::overwrite_existing, problem);
  if (problem)
    failFile("cannot be copied to " + fs::temp_directory_path().string(), o.from, problem,
             "Or set TMPDIR to another folder");
  fs::permissions(copy.name(), fs::perms::owner_read | fs::perms::owner_write, problem);
  const std::size_t rows = copied(copy.name(), o.url);
  std::printf("Restored: %s into the %s\n", counted(rows, "row").c_str(),
              record::RecordStore(o.url).place().c_str());
}

void migrateRecords(const RecordsOptions& o) {
  const auto connection = record::connect(o.url);
  const int found = record::migrate(*connection), now = record::schemaOf(*connection);
  if (found == now)
    std::printf("The %s has tables of version %d, the newest that this program knows\n",
                connection->place().c_str(), now);
  else
    std::printf("The %s: tables brought from version %d to %d\n", connection->place().c_str(),
                found, now);
}

namespace {

using People = std::vector<record::Trainee>;

People chosen(record::RecordStore& store, const RecordsOptions& o) {
  if (o.trainee.id.empty() != o.all)
    throw UsageError("states whose records are meant", "--id or --all", "Give one of them");
  return o.all ? store.trainees() : People{traineeIn(store, o.trainee.id)};
}

/// Keeps who has agreed; says how many are left out.
void keepAgreed(People& people, std::string record::Trainee::*consent, const char* to_what) {
  const std::size_t before = people.size();
  std::erase_if(people, [consent](const record::Trainee& t) { return (t.*consent).empty(); });
  if (const std::size_t out = before - people.size(); out > 0)
    std::printf("Left out: %s who %s not agreed to %s\n", counted(out, "trainee").c_str(),
                out == 1 ? "has" : "have", to_what);
}

link::DataFormat formatOf(const std::string& name) {
  return name == "csv"    ? link::DataFormat::csv
         : name == "json" ? link::DataFormat::json
                          : link::DataFormat::both;
}

void sayQueued(const link::Queued& q) {
  std::printf("%s queued, %d known already\n", counted(q.added, "statement").c_str(), q.known);
  if (q.simulated > 0)
    std::printf("Left out: %s of simulated sessions (--simulated includes them)\n",
                counted(q.simulated, "trial").c_str());
  if (q.void_trials > 0)
    std::printf("Left out: %s that do not count (void)\n", counted(q.void_trials, "trial").c_str());
  if (q.no_uuid > 0)
    std::printf("Left out: %s of sessions without a UUID\n", counted(q.no_uuid, "trial").c_str());
}

void queue(const RecordsOptions& o, const link::Route& route, link::Outbox& outbox) {
  record::RecordStore store(o.url);
  if (const int back = link::takeBackDeleted(store, route, outbox); back > 0)
    std::printf("%s taken back: deleted people, void trials\n", counted(back, "statement").c_str());
  if (!o.all && o.trainee.id.empty()) return;  // what waits is sent
  link::StatementFilter filter{
      chosen(store, o), o.simulated,
      o.home_page.empty() ? std::string(link::kNames) + "/trainees" : o.home_page};
  keepAgreed(filter.who, &record::Trainee::consent_utc, "keeping training records");
  sayQueued(link::queueTrials(store, route, filter, outbox));
}

}  // namespace

void exportRecords(const RecordsOptions& o) {
  requireRecords(o.url);
  record::RecordStore store(o.url);
  People people = chosen(store, o);
  if (o.research) keepAgreed(people, &record::Trainee::research_utc, "use in studies");
  session::OutputFolder output(o.out, "records");
  const std::filesystem::path& folder = output.path();
  const record::SqlTransaction moment(store.connection(), record::Access::read);
  const link::ExportSource source{store.connection(), people, o.paths};
  const auto written = link::writeTables(link::tablesOf(source), formatOf(o.format), folder);
  output.keep();
  const link::Extent extent = link::extentOf(source);
  std::printf("%s, %s (%zu simulated), %s\n", counted(people.size(), "trainee").c_str(),
              counted(extent.sessions, "session").c_str(), extent.simulated,
              counted(extent.trials, "trial").c_str());
  std::printf("Written to %s:\n", folder.string().c_str());
  for (const std::string& name : written) std::printf("  %s\n", name.c_str());
}

void sendRecords(const RecordsOptions& o) {
  const link::Endpoint endpoint = link::endpointOf(o.to, o.insecure);
  const link::Login login = link::loginFor(endpoint.host, o.user);
  link::Outbox outbox(link::Outbox::usualFile());
  queue(o, {endpoint.text(), evidence::absoluteRecords(o.url)}, outbox);
  link::LrsClient client(endpoint, login);
  const link::Sent sent = link::sendWaiting(outbox, endpoint, client);
  std::printf("%s: %s delivered, %d there already, %zu waiting\n", endpoint.text().c_str(),
              counted(sent.delivered, "statement").c_str(), sent.present, sent.left);
  if (!sent.trouble.empty())
    throw Error("cannot take statements now (" + sent.trouble + ")", endpoint.text(),
                "What waits is kept on this station; the same command sends it later");
  if (!sent.refused.empty())
    throw Error(
        "refuses " + counted(sent.refused.size(), "statement") + " (" + sent.refused.front() + ")",
        endpoint.text(), "Everything else was delivered; ask whoever runs it");
}

}  // namespace palpa::cli
