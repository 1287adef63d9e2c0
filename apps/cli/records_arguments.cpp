#include <cstdlib>
#include <filesystem>

#include "anatomy/base/error.h"
#include "apps/cli/arguments.h"
#include "apps/os/file_access.h"
#include "apps/record/store/record_store.h"
#include "apps/record/store/sql_connection.h"

namespace palpa::cli {
namespace {

namespace fs = std::filesystem;

/// Where it cannot be made, opening says what is wrong.
void makeFolderOf(const std::string& url) {
  if (!record::isServer(url)) os::makeFolders(fs::absolute(url).parent_path());
}

}  // namespace

std::string usualRecords() {
  if (const char* url = std::getenv("PALPA_RECORDS"); url && *url) return url;
  return (os::dataFolder("Set HOME, or say where the records are: --records FILE") /
          "palpa/records.sqlite")
      .string();
}

std::filesystem::path usualConsoleHome() {
  return os::dataFolder("Set HOME, or say where sessions are kept: --home DIR") / "palpa/console";
}

std::string usualRecordsMade() {
  std::string url = usualRecords();
  makeFolderOf(url);
  return url;
}

void requireRecords(const std::string& url) {
  record::requireAddress(url);
  if (record::isServer(url)) return;
  std::error_code none;
  const bool there = fs::exists(url, none);
  if (there && (fs::is_directory(url, none) || fs::file_size(url, none) > 0)) return;
  throw UsageError(there ? "is empty" : "is not there", "records file " + url,
                   there ? "Restore it from a backup: palpa records restore"
                         : "Give the right one: --records; the first trainee makes one: palpa "
                           "records trainee add");
}

void addRecordsArgument(CLI::App& command, std::string& url) {
  command
      .add_option("--records", url,
                  "Records: a file, or postgresql://user@host/database (default: $PALPA_RECORDS, "
                  "else ~/.local/share/palpa/records.sqlite)")
      ->type_name("FILE|URL");
  command.parse_complete_callback(
      [&url] { url.empty() ? void(url = usualRecordsMade()) : record::requireAddress(url); });
}

}  // namespace palpa::cli
