#include "apps/os/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace palpa::os {

std::unique_ptr<FileLock> FileLock::exclusive(const std::filesystem::path& file, Missing missing) {
  const int flags = missing == Missing::is_made ? O_RDWR | O_CREAT : O_RDONLY;
  const int descriptor = ::open(file.c_str(), flags | O_CLOEXEC, 0600);
  if (descriptor < 0) return nullptr;
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0)
    return std::unique_ptr<FileLock>(new FileLock(descriptor));
  ::close(descriptor);
  return nullptr;
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
