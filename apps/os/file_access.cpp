#include "apps/os/file_access.h"

#include <fcntl.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <sys/file.h>
#include <cerrno>
#include <cstdlib>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"

namespace palpa::os {
namespace {

namespace fs = std::filesystem;
constexpr mode_t kUserAlone = 0600, kUsersFolder = 0700, kOthers = 0077;

std::error_code lastError() { return {errno, std::system_category()}; }

std::error_code opened(const fs::path& file, int flags) {
  const int descriptor = ::open(file.c_str(), flags | O_CLOEXEC, kUserAlone);
  if (descriptor < 0) return lastError();
  ::close(descriptor);
  return {};
}

fs::path folderOf(const char* variable, const char* in_home, const std::string& advice) {
  if (const char* folder = std::getenv(variable); folder && *folder == '/') return folder;
  const char* home = std::getenv("HOME");
  if (home && *home == '/') return fs::path(home) / in_home;
  throw UsageError(std::string("is not known, for neither HOME nor ") + variable + " is set",
                   "this user's folder", advice);
}

}  // namespace

std::error_code createNew(const fs::path& file) {
  return opened(file, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW);
}

std::error_code createPrivate(const fs::path& file) {
  if (const std::error_code problem = createNew(file); problem != std::errc::file_exists)
    return problem;
  struct stat facts {};
  if (::lstat(file.c_str(), &facts) != 0) return lastError();
  if (S_ISLNK(facts.st_mode)) return make_error_code(std::errc::too_many_symbolic_link_levels);
  if (!S_ISREG(facts.st_mode)) return make_error_code(std::errc::operation_not_permitted);
  return ::faccessat(AT_FDCWD, file.c_str(), W_OK, AT_EACCESS) == 0 ? std::error_code{}
                                                                    : lastError();
}

std::error_code appendPrivate(const fs::path& file, const std::string& text) {
  if (const std::error_code made = createNew(file); made && made != std::errc::file_exists)
    return made;
  constexpr int kNoneElse = O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;  // no link, no pipe that waits
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_APPEND | kNoneElse);
  if (descriptor < 0) return lastError();
  std::error_code problem;
  struct stat facts {};
  if (::fstat(descriptor, &facts) != 0)
    problem = lastError();
  else if (!S_ISREG(facts.st_mode) || facts.st_uid != ::geteuid())
    problem = make_error_code(std::errc::operation_not_permitted);
  else if (::write(descriptor, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
    problem = make_error_code(std::errc::no_space_on_device);
  ::close(descriptor);
  return problem;
}

std::error_code makeFolders(const fs::path& folder) {
  fs::path upto;
  for (const fs::path& part : folder) {
    upto /= part;
    if (part.empty() || part == "/" || part == "." || part == "..") continue;
    if (::mkdir(upto.c_str(), kUsersFolder) == 0) {
      WrittenTogether::note(upto);
      continue;
    }
    const std::error_code problem = lastError();
    std::error_code none;
    if (!fs::is_directory(upto, none))
      return problem == std::errc::file_exists ? make_error_code(std::errc::not_a_directory)
                                               : problem;
  }
  return {};
}

bool mayWrite(const fs::path& path) { return ::access(path.c_str(), W_OK) == 0; }

std::string userName() {
  const passwd* const user = ::getpwuid(::geteuid());
  return user ? user->pw_name : std::to_string(::geteuid());
}

Privacy privacyOf(const fs::path& file) {
  struct stat facts {};
  if (::stat(file.c_str(), &facts) != 0) return Privacy::missing;
  return (facts.st_mode & kOthers) != 0 ? Privacy::shared : Privacy::own;
}

TemporaryFolder::TemporaryFolder(const std::string& prefix) {
  std::string name = (fs::temp_directory_path() / (prefix + "XXXXXX")).string();
  made_ = ::mkdtemp(name.data()) != nullptr;
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (made_) fs::remove_all(path_, ignored);
}

fs::path dataFolder(const std::string& advice) {
  return folderOf("XDG_DATA_HOME", ".local/share", advice);
}

fs::path stateFolder(const std::string& advice) {
  return folderOf("XDG_STATE_HOME", ".local/state", advice);
}

fs::path cacheFolder(const std::string& advice) {
  return folderOf("XDG_CACHE_HOME", ".cache", advice);
}

std::string programStamp() {
  std::error_code none;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", none);
  const auto written = std::filesystem::last_write_time(program, none).time_since_epoch();
  return program.string() + ' ' + std::to_string(std::filesystem::file_size(program, none)) + ' ' +
         std::to_string(written.count());
}

bool errorsGoToTerminal() { return ::isatty(STDERR_FILENO) != 0; }

namespace {

/// What is open is still what has this name.
bool isAt(const fs::path& file, int descriptor) {
  struct stat open {
  }, named{};
  return ::fstat(descriptor, &open) == 0 && ::stat(file.c_str(), &named) == 0 &&
         open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

}  // namespace

std::unique_ptr<FileLock> FileLock::exclusive(const std::filesystem::path& file, Missing missing) {
  const int flags = O_RDWR | (missing == Missing::is_made ? O_CREAT | O_NOFOLLOW : 0);
  for (;;) {
    const int descriptor = ::open(file.c_str(), flags | O_CLOEXEC, 0600);
    if (descriptor < 0) return nullptr;
    const bool locked = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
    if (locked && isAt(file, descriptor))
      return std::unique_ptr<FileLock>(new FileLock(descriptor));
    ::close(descriptor);
    if (!locked) return nullptr;
  }
}

FileLock::~FileLock() { ::close(descriptor_); }

bool isLocked(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool locked = ::flock(descriptor, LOCK_SH | LOCK_NB) != 0;
  ::close(descriptor);
  return locked;
}

}  // namespace palpa::os
