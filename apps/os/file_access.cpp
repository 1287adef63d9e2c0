#include "apps/os/file_access.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>

namespace palpa::os {
namespace {

namespace fs = std::filesystem;
constexpr mode_t kAllMayRead = 0644, kUserAlone = 0600, kOthers = 0077;

std::error_code created(const fs::path& file, int flags, mode_t mode) {
  const int descriptor = ::open(file.c_str(), flags | O_CREAT | O_CLOEXEC, mode);
  if (descriptor < 0) return {errno, std::system_category()};
  ::close(descriptor);
  return {};
}

fs::path folderOf(const char* variable, const char* in_home, const fs::path& homeless) {
  if (const char* folder = std::getenv(variable); folder && *folder == '/') return folder;
  const char* home = std::getenv("HOME");
  return (home && *home ? fs::path(home) : homeless) / in_home;
}

}  // namespace

std::error_code createNew(const fs::path& file) {
  return created(file, O_EXCL | O_WRONLY, kAllMayRead);
}

std::error_code createPrivate(const fs::path& file) { return created(file, O_RDWR, kUserAlone); }

bool mayWrite(const fs::path& path) { return ::access(path.c_str(), W_OK) == 0; }

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

fs::path dataFolder(const fs::path& homeless) {
  return folderOf("XDG_DATA_HOME", ".local/share", homeless);
}

fs::path stateFolder(const fs::path& homeless) {
  return folderOf("XDG_STATE_HOME", ".local/state", homeless);
}

std::string programStamp() {
  std::error_code none;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", none);
  const auto written = std::filesystem::last_write_time(program, none).time_since_epoch();
  return program.string() + ' ' + std::to_string(std::filesystem::file_size(program, none)) + ' ' +
         std::to_string(written.count());
}

bool errorsGoToTerminal() { return ::isatty(STDERR_FILENO) != 0; }

}  // namespace palpa::os
