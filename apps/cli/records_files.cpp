#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "anatomy/geometry/error.h"
#include "apps/cli/records_actions.h"
#include "apps/cli/records_place.h"
#include "apps/record/store/backup.h"
#include "apps/record/store/migrations.h"

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
    throw UsageError("is there already, and a backup never overwrites", o.out,
                     "Give another name, such as one with today's date");
  const PassingFile beside(o.out + "." + std::to_string(::getpid()) + ".part");
  const std::size_t rows = copied(o.url, beside.name());
  std::error_code problem;
  fs::rename(beside.name(), o.out, problem);
  if (problem)
    throw Error("cannot be written (" + problem.message() + ")", o.out, "Choose another place");
  std::printf("Written: %s, %s\n", o.out.c_str(), counted(rows, "row").c_str());
}

/// From a copy, so that the backup stays as it is, even on a medium that cannot be written.
void restoreRecords(const RecordsOptions& o) {
  if (!fs::is_regular_file(o.from))
    throw UsageError("is no file", o.from, "Give a backup that palpa records backup wrote");
  requireRecords(o.from);
  std::string folder = (fs::temp_directory_path() / "palpa-restore-XXXXXX").string();
  if (!::mkdtemp(folder.data()))
    throw Error("cannot be made", folder, "Free space there, or set TMPDIR");
  const PassingFile own{fs::path(folder)};
  const PassingFile copy(fs::path(folder) / fs::path(o.from).filename());
  std::error_code problem;
  fs::copy_file(o.from, copy.name(), fs::copy_options::overwrite_existing, problem);
  if (problem)
    throw Error("cannot be copied (" + problem.message() + ")", o.from,
                "Free space in " + fs::temp_directory_path().string() + ", or set TMPDIR");
  fs::permissions(copy.name(), fs::perms::owner_read | fs::perms::owner_write, problem);
  const std::size_t rows = copied(copy.name(), o.url);
  std::printf("Restored: %s into the %s\n", counted(rows, "row").c_str(),
              record::connect(o.url)->place().c_str());
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

}  // namespace palpa::cli
