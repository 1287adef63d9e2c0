#pragma once

#include <filesystem>
#include <string>

#include "anatomy/base/whole_file.h"

namespace palpa::session {

struct SessionRun;

/// `given`, else out/<command>-<time>; made where it is missing, for this user alone, and proven
/// writable before any work is done. Throws Error.
std::filesystem::path makeOutputFolder(const std::string& given, const std::string& command);

/// The same for a command whose results belong together: unless `keep` is called, what it has
/// written is gone again at the end, and the folders that were made for it. A session's evidence
/// stays, with all that belongs to it, once it holds a single tick.
class OutputFolder {
 public:
  OutputFolder(const std::string& given, const std::string& command);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  bool hasOlderSession() const { return has_older_session_; }  ///< another's evidence is in it
  void keep() { written_.keep(), kept_ = true; }

 private:
  WrittenTogether written_;
  const std::filesystem::path path_;
  const bool has_older_session_;
  bool kept_ = false;
};

/// Says which files a session left in its folder. `report`: what its page tells; `row`: of what
/// the table has one each.
void sayWritten(const SessionRun& run, const std::filesystem::path& folder, const char* report,
                const char* row);

}  // namespace palpa::session
