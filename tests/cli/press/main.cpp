#include <string>

#include "apps/os/local_socket.h"
#include "apps/os/socket.h"

/// press SOCKET: the emergency stop of the session whose socket that is, as the console presses it;
/// 0 once it is confirmed.
int main(int count, char** words) {
  using namespace palpa::os;
  if (count != 2) return 2;
  const int socket = connectTo(std::string(words[1]) + "!");
  const std::string stop("S\0\0\0\0", 5);  // apps/live/wire.h
  char answer[8];
  const bool confirmed = socket >= 0 && sendSome(socket, stop.data(), stop.size()) == stop.size() &&
                         ready(socket, Wait::to_read, 30'000) &&
                         receiveSome(socket, answer, sizeof answer) == stop.size();
  return confirmed ? 0 : 1;
}
