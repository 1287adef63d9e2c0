#include "apps/cli/records_place.h"

#include <cstdlib>
#include <filesystem>

#include "anatomy/geometry/error.h"
#include "apps/record/store/sql_connection.h"

namespace palpa::cli {
namespace {

namespace fs = std::filesystem;

void makeFolderOf(const std::string& url) {
  std::error_code ignored;  // opening says what is wrong
  if (!record::isServer(url) && url.find("://") == std::string::npos)
    fs::create_directories(fs::absolute(url).parent_path(), ignored);
}

}  // namespace

std::string usualRecords() {
  if (const char* url = std::getenv("PALPA_RECORDS"); url && *url) return url;
  if (const char* data = std::getenv("XDG_DATA_HOME"); data && *data == '/')
    return (fs::path(data) / "palpa/records.sqlite").string();
  const char* home = std::getenv("HOME");
  return (fs::path(home && *home ? home : ".") / ".local/share/palpa/records.sqlite").string();
}

std::string usualRecordsMade() {
  const std::string url = usualRecords();
  makeFolderOf(url);
  return url;
}

void requireRecords(const std::string& url) {
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
  command.parse_complete_callback([&url] {
    if (!url.empty()) return;
    url = usualRecordsMade();
  });
}

}  // namespace palpa::cli
