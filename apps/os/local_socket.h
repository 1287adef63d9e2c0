#pragma once

#include <string>

namespace palpa::os {

/// A listening Unix socket at `path`, readable by this user only. A socket of this user's at which
/// nobody listens any more is replaced; anything else that is there stays, and Error is thrown.
/// `advice`: where there can be none.
int listenAt(const std::string& path,
             const std::string& advice = "Give a folder that can be written to");
/// Removes what listenAt has made, where it is a socket of this user's still.
void removeSocket(const std::string& path);
/// Both for as long as it lives, whatever ends it.
class LocalListener {
 public:
  LocalListener(const std::string& path, const std::string& advice)
      : path_(path), socket_(listenAt(path, advice)) {}
  ~LocalListener();
  LocalListener(const LocalListener&) = delete;
  LocalListener& operator=(const LocalListener&) = delete;
  int socket() const { return socket_; }

 private:
  const std::string path_;
  const int socket_;
};
/// Connected, or -1: nobody is there, or nobody can be (the path is too long for a socket).
int connectTo(const std::string& path);
/// The process at the other end runs as the same user.
bool sameUser(int socket);

/// Where sockets of sessions are: $XDG_RUNTIME_DIR/palpa, else palpa-<user id> among the temporary
/// files; made, readable by this user only. Throws Error where somebody else owns it.
std::string socketFolder();

}  // namespace palpa::os
