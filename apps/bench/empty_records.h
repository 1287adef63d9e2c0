#pragma once

#include <filesystem>
#include <string>

#include "anatomy/base/error.h"
#include "apps/os/file_access.h"
#include "apps/record/store/record_store.h"

namespace palpa::bench {

/// Records in which nobody is yet: those that were given, where what is drawn stays, or a file that
/// passes.
struct EmptyRecords {
  /// Throws Error; UsageError for records that hold somebody.
  explicit EmptyRecords(const std::string& given)
      : folder("palpa-bench-records-"),
        place(given.empty() ? (made(folder) / "records.sqlite").string() : given),
        store(place) {
    if (!store.trainees().empty())
      throw UsageError("holds records already", store.place(),
                       "Give an empty database or a new file");
  }
  const char* kind() const { return record::isServer(place) ? "postgresql" : "sqlite"; }

  const os::TemporaryFolder folder;  ///< for what else passes
  const std::string place;
  record::RecordStore store;

 private:
  static const std::filesystem::path& made(const os::TemporaryFolder& folder) {
    if (!folder.made())
      throw Error("cannot be made", folder.path().string(), "Free space there, or set TMPDIR");
    return folder.path();
  }
};

}  // namespace palpa::bench
