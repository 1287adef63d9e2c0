#include "apps/record/evidence.h"

#include <sqlite3.h>

#include <cstring>
#include <fstream>

#include "apps/os/file_access.h"
#include "apps/record/schema.h"

namespace palpa::record {
namespace {

namespace fs = std::filesystem;

void checkLooksLikeSqlite(const fs::path& file) {
  std::error_code problem;
  if (!fs::is_regular_file(file, problem)) {
    throw Error("no such file", file.string(), "Give the session.palpa of a session's folder");
  }
  char start[16] = {};
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    throw Error("cannot be read", file.string(), "Check the permissions of the file");
  }
  stream.read(start, sizeof(start));
  if (stream.gcount() == 0) {
    throw Error("is empty", file.string(), "Restore it from a backup");
  }
  if (stream.gcount() != sizeof(start) || std::memcmp(start, "SQLite format 3", 16) != 0) {
    throw Error("is not a session file", file.string(),
                "Give the session.palpa of a session's folder");
  }
}

void checkIdentity(Database& database) {
  const std::string where = database.file().string();
  if (database.integer("PRAGMA application_id") != kApplicationId) {
    throw Error("is a database of another program", where,
                "Give the session.palpa of a session's folder");
  }
  const std::int64_t version = database.integer("PRAGMA user_version");
  if (version > kSchemaVersion) {
    throw Error("was written by a newer version of Palpa (file version " + std::to_string(version) +
                    ", known up to " + std::to_string(kSchemaVersion) + ")",
                where, "Update Palpa");
  }
  if (version != kSchemaVersion) {
    throw Error("has no valid version (" + std::to_string(version) + ")", where,
                "The file is damaged: restore it from a backup");
  }
}

bool hasLog(const fs::path& file) {
  std::error_code problem;
  const auto size = fs::file_size(file.string() + "-wal", problem);
  return !problem && size > 0;
}

}  // namespace

void Evidence::openCopy(const fs::path& file) {
  copy_ = std::make_unique<os::TemporaryFolder>("palpa-");
  if (!copy_->made()) {
    throw Error("no temporary folder can be made", copy_->path().string(),
                "Set TMPDIR to a folder with free space");
  }
  const fs::path target = copy_->path() / "session.palpa";
  fs::copy_file(file, target);
  fs::copy_file(file.string() + "-wal", target.string() + "-wal");
  database_ = std::make_unique<Database>(target, Database::Mode::read);
}

Evidence::Evidence(const fs::path& file) {
  checkLooksLikeSqlite(file);
  try {
    database_ = std::make_unique<Database>(file, Database::Mode::read);
    database_->integer("PRAGMA schema_version");  // the first real access
  } catch (const DatabaseError& error) {
    if (error.code != SQLITE_CANTOPEN && error.code != SQLITE_READONLY) throw;
    database_.reset();
    if (hasLog(file)) {
      openCopy(file);
    } else {
      database_ = std::make_unique<Database>(file, Database::Mode::read_immutable);
    }
  }
  checkIdentity(*database_);
}

Evidence::~Evidence() = default;

}  // namespace palpa::record
