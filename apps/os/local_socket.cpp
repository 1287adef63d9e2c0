#include "apps/os/local_socket.h"

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"

namespace palpa::os {
namespace {

constexpr int kBacklog = 8;

bool fits(const std::string& path) {
  return path.size() < sizeof sockaddr_un{}.sun_path && path.find('\0') == std::string::npos;
}

sockaddr_un addressOf(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (!fits(path))
    throw Error("is too long for a socket", path, "Set XDG_RUNTIME_DIR to a shorter one");
  std::memcpy(address.sun_path, path.c_str(), path.size());
  return address;
}

int unixSocket() { return ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0); }

}  // namespace

int connectTo(const std::string& path) {
  if (!fits(path)) return -1;
  const sockaddr_un address = addressOf(path);
  const int socket = unixSocket();
  if (socket < 0) return -1;
  if (::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 &&
      sameUser(socket))
    return socket;
  ::close(socket);
  return -1;
}

namespace {

enum class Place { free, dead_socket, in_use, something_else };

/// A socket that was not asked, because its queue is full, say, counts as in use.
Place whatIsAt(const std::string& path, const sockaddr_un& address) {
  struct stat facts {};
  if (::lstat(path.c_str(), &facts) != 0) return Place::free;
  if (!S_ISSOCK(facts.st_mode) || facts.st_uid != ::geteuid()) return Place::something_else;
  const int socket = unixSocket();
  if (socket < 0) return Place::in_use;
  const bool refused =
      ::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 &&
      errno == ECONNREFUSED;
  ::close(socket);
  return refused ? Place::dead_socket : Place::in_use;
}

}  // namespace

void removeSocket(const std::string& path) {
  struct stat facts {};
  if (::lstat(path.c_str(), &facts) == 0 && S_ISSOCK(facts.st_mode) && facts.st_uid == ::geteuid())
    ::unlink(path.c_str());
}

/// In this order: while it listens, nobody else takes the name, so the file is its own.
LocalListener::~LocalListener() {
  removeSocket(path_);
  ::close(socket_);
}

int listenAt(const std::string& path, const std::string& advice) {
  const sockaddr_un address = addressOf(path);
  const Place place = whatIsAt(path, address);
  if (place == Place::in_use)
    throw Error("is in use by another session", path, "End that one first");
  if (place == Place::something_else)
    throw Error("is there already, and is no socket of yours: it is left as it is", path,
                "Give another name");
  if (place == Place::dead_socket) ::unlink(path.c_str());
  const int socket = unixSocket();
  const mode_t mask = ::umask(0177);
  const bool bound = socket >= 0 && ::bind(socket, reinterpret_cast<const sockaddr*>(&address),
                                           sizeof address) == 0;
  const bool listens = bound && ::listen(socket, kBacklog) == 0;
  const int error = errno;
  ::umask(mask);
  if (listens) return socket;
  if (bound) ::unlink(path.c_str());
  if (socket >= 0) ::close(socket);
  failFile("cannot be made", "local socket " + path, error, advice);
}

bool sameUser(int socket) {
  ucred peer{};
  socklen_t size = sizeof peer;
  return ::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0 &&
         peer.uid == ::geteuid();
}

std::string socketFolder() {
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  std::error_code none;
  const std::filesystem::path temporary = std::filesystem::temp_directory_path(none);
  std::string folder =
      runtime && *runtime == '/'
          ? std::string(runtime) + "/palpa"
          : ((none ? "/tmp" : temporary) / ("palpa-" + std::to_string(::geteuid()))).string();
  if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST)
    failFile("cannot be made", folder, errno, "Set XDG_RUNTIME_DIR to a folder of yours");
  struct stat facts {};
  if (::lstat(folder.c_str(), &facts) != 0 || !S_ISDIR(facts.st_mode) ||
      facts.st_uid != ::geteuid() || (facts.st_mode & 0077) != 0)
    throw Error("is not a folder for this user alone", folder,
                "Remove it, or set XDG_RUNTIME_DIR to a folder of yours");
  return folder;
}

}  // namespace palpa::os
