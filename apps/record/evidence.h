#pragma once

#include <filesystem>
#include <memory>

#include "apps/record/sqlite.h"

namespace palpa::os {
class TemporaryFolder;
}

namespace palpa::record {

/// A session file opened for reading, in the gentlest way that works:
///   1. read only. A write-ahead log that a killed process left is read where it lies; neither file
///      changes. While it is open SQLite may keep an index (`-shm`) beside them.
///   2. no log there and the folder cannot be written to: read only and immutable.
///   3. a log there and the folder cannot be written to: a private copy of both in the temporary
///      folder, removed afterwards.
/// Throws Error for what is not a session file, or one of a newer version.
class Evidence {
 public:
  explicit Evidence(const std::filesystem::path& file);
  ~Evidence();
  Database& database() { return *database_; }

 private:
  void openCopy(const std::filesystem::path& file);

  std::unique_ptr<os::TemporaryFolder> copy_;  // outlives the connection
  std::unique_ptr<Database> database_;
};

}  // namespace palpa::record
