#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

namespace palpa::os {

/// Makes an empty file that this user alone may read. std::errc::file_exists where the name is
/// taken, also by a link, or by another process a moment ago: what is there stays as it is.
std::error_code createNew(const std::filesystem::path& file);
/// The same, unless there is one: that stays as it is, whoever's it is, and must be a file that
/// this user may write. It is not opened: to close it would let go of the locks that this program
/// has on it. std::errc::too_many_symbolic_link_levels for a link, which is never followed.
std::error_code createPrivate(const std::filesystem::path& file);
/// Writes `text` behind what such a file holds, where it is this user's own.
std::error_code appendPrivate(const std::filesystem::path& file, const std::string& text);
/// Makes a folder and those above it that are missing, for this user alone. Those that are there
/// stay as they are.
std::error_code makeFolders(const std::filesystem::path& folder);

/// This user may write to the file, or into the folder.
bool mayWrite(const std::filesystem::path& path);
/// The name of the user that this process belongs to; its number where it has none.
std::string userName();

enum class Privacy { missing, shared, own };
/// `own`: nobody but its owner may read or write it.
Privacy privacyOf(const std::filesystem::path& file);

/// A folder among the temporary files that this user alone may enter; removed at the end of its
/// life with all that is in it.
class TemporaryFolder {
 public:
  /// Its name begins with `prefix`. Where it cannot be made, `made` says so.
  explicit TemporaryFolder(const std::string& prefix);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  bool made() const { return made_; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  bool made_ = false;
};

/// This user's folder for what programs must not lose: $XDG_DATA_HOME, else ~/.local/share. Not
/// made. Throws UsageError where neither is set, with the caller's advice: nothing is written in
/// odd places.
std::filesystem::path dataFolder(const std::string& advice);
/// For what a program remembers between its runs: $XDG_STATE_HOME, else ~/.local/state.
std::filesystem::path stateFolder(const std::string& advice);
/// For what it can make again: $XDG_CACHE_HOME, else ~/.cache.
std::filesystem::path cacheFolder(const std::string& advice);

/// Tells builds of a program apart: where the running one lies, its size, when it was last written.
std::string programStamp();

/// Standard error is a terminal: a line may renew itself there.
bool errorsGoToTerminal();

/// A file that one holder at a time has. Given back at the end of its life, or with the process,
/// however that ends.
class FileLock {
 public:
  enum class Missing { fails, is_made };  ///< made: readable by this user alone
  /// Never waits. Null where another holds it, or the file cannot be opened. Whoever holds it may
  /// remove the file: a lock on a file that has lost its name is nobody's.
  static std::unique_ptr<FileLock> exclusive(const std::filesystem::path& file, Missing missing);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  const int descriptor_;
};

/// Somebody holds it now. False where there is no such file.
bool isLocked(const std::filesystem::path& file);

}  // namespace palpa::os
