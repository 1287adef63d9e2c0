#include "apps/record/store/store_look.h"

#include <filesystem>

#include "apps/os/file_access.h"
#include "apps/record/store/migrations.h"
#include "apps/record/store/sql_connection.h"

namespace palpa::record {
namespace {

namespace fs = std::filesystem;

/// Without bytes, or not there.
bool isEmpty(const std::string& file) {
  std::error_code none;
  return fs::file_size(file, none) == 0 || none;
}

/// A session writes into the file, and beside it into its log.
void requireWritable(const std::string& file) {
  std::error_code none;
  const fs::path folder = fs::absolute(file, none).parent_path();
  for (const fs::path& path : {fs::path(file), folder})
    if (!os::mayWrite(path))
      throw Error("may not be written by this user", "records file " + file,
                  "Make the file and its folder writable (chmod u+w " + path.string() +
                      "), or name other records: PALPA_RECORDS");
}

}  // namespace

StoreLook lookAtStore(const std::string& url) {
  StoreLook look;
  if (!isServer(url) && url.find("://") == std::string::npos && !url.empty()) {
    look.place = "records file " + url;
    std::error_code none;
    if (!fs::exists(url, none)) return look;
    look.state = StoreState::empty;
    if (fs::is_regular_file(url, none)) requireWritable(url);
    if (isEmpty(url) && isEmpty(url + "-wal")) return look;
  }
  const std::unique_ptr<SqlConnection> connection = connectToRead(url);
  look.place = connection->place();
  look.schema = schemaOf(*connection);
  look.state = look.schema == 0               ? StoreState::empty
               : look.schema < newestSchema() ? StoreState::older
                                              : StoreState::current;
  if (look.schema > 0)
    look.trainees =
        static_cast<std::size_t>(connection->query("SELECT count(*) FROM trainees").integer(0, 0));
  return look;
}

}  // namespace palpa::record
