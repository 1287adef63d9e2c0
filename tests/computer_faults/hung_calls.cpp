#include "hung_calls.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string_view>

namespace palpa::test {
namespace {

template <class Function>
Function* realCall(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

/// The system's own calls: the library's may be ours.
struct Wish {
  char text[32] = {};
  std::string_view kind() const { return text; }
  explicit Wish(const char* file) noexcept {
    const auto fd = static_cast<int>(syscall(SYS_openat, AT_FDCWD, file, O_RDONLY | O_CLOEXEC));
    if (fd < 0) return;
    syscall(SYS_read, fd, text, sizeof text - 1);
    syscall(SYS_close, fd);
    for (char& c : text)
      if (c == '\n' || c == ' ') c = '\0';
  }
};

const char* fileOfWish() noexcept {
  static const char* file = std::getenv("PALPA_HANG");
  return file;
}

std::string_view kindOfSocket(int descriptor) noexcept {
  int domain = 0, type = 0;
  socklen_t size = sizeof domain;
  getsockopt(descriptor, SOL_SOCKET, SO_DOMAIN, &domain, &size);
  getsockopt(descriptor, SOL_SOCKET, SO_TYPE, &type, &size);
  if (domain != AF_UNIX) return type == SOCK_DGRAM ? "datagram" : "stream";
  sockaddr_un own{};
  size = sizeof own - 1;
  getsockname(descriptor, reinterpret_cast<sockaddr*>(&own), &size);
  const std::string_view path = own.sun_path;
  return path.empty() || path.ends_with('!') ? "" : "local";
}

std::string_view kindOfFile(int descriptor) noexcept {
  char link[64], path[512] = {};
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  if (readlink(link, path, sizeof path - 1) < 0) return "";
  const std::string_view whole = path, name = whole.substr(whole.rfind('/') + 1);
  if (name.starts_with("session.palpa")) return "evidence";
  return name.ends_with(".mjpeg") ? "film" : "";
}

std::string_view kindOf(int descriptor) noexcept {
  struct stat facts {};
  if (fstat(descriptor, &facts) != 0) return "";
  if (S_ISSOCK(facts.st_mode)) return kindOfSocket(descriptor);
  return S_ISREG(facts.st_mode) ? kindOfFile(descriptor) : "";
}

void sayReached(const char* file) noexcept {
  char reached[512];
  std::snprintf(reached, sizeof reached, "%s.reached", file);
  const long fd = syscall(SYS_openat, AT_FDCWD, reached, O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  if (fd >= 0) syscall(SYS_close, fd);
}

void waitFor(std::string_view kind) noexcept {
  const char* file = fileOfWish();
  const int error = errno;
  bool said = false;
  while (!kind.empty() && Wish(file).kind() == kind) {
    if (!said) sayReached(file);
    said = true;
    const timespec rest{0, 5'000'000};
    syscall(SYS_nanosleep, &rest, nullptr);
  }
  errno = error;
}

}  // namespace

void waitWhileHung(int descriptor) noexcept {
  const char* file = fileOfWish();
  if (!file) return;
  const int error = errno;
  if (!Wish(file).kind().empty()) waitFor(kindOf(descriptor));
  errno = error;
}

void waitWhileHung(const char* kind) noexcept {
  if (fileOfWish()) waitFor(kind);
}

}  // namespace palpa::test

using palpa::test::realCall;
using palpa::test::waitWhileHung;

extern "C" {

ssize_t recv(int socket, void* bytes, size_t size, int flags) {
  static auto* real = realCall<ssize_t(int, void*, size_t, int)>("recv");
  waitWhileHung(socket);
  return real(socket, bytes, size, flags);
}

/// What `recv` is where the buffer's size is known: the C library's name for it.
// NOLINTNEXTLINE(bugprone-reserved-identifier,readability-identifier-naming)
ssize_t __recv_chk(int socket, void* bytes, size_t size, size_t, int flags) {
  return recv(socket, bytes, size, flags);
}

ssize_t send(int socket, const void* bytes, size_t size, int flags) {
  static auto* real = realCall<ssize_t(int, const void*, size_t, int)>("send");
  waitWhileHung(socket);
  return real(socket, bytes, size, flags);
}

int accept4(int socket, sockaddr* address, socklen_t* size, int flags) {
  static auto* real = realCall<int(int, sockaddr*, socklen_t*, int)>("accept4");
  waitWhileHung(socket);
  return real(socket, address, size, flags);
}

ssize_t read(int file, void* bytes, size_t size) {
  static auto* real = realCall<ssize_t(int, void*, size_t)>("read");
  waitWhileHung(file);
  return real(file, bytes, size);
}

// NOLINTNEXTLINE(bugprone-reserved-identifier,readability-identifier-naming)
ssize_t __read_chk(int file, void* bytes, size_t size, size_t) { return read(file, bytes, size); }
}
