#pragma once

#include <httplib.h>
#undef _res  // a macro of <resolv.h>, a name in Eigen

#include <functional>
#include <string>
#include <utility>

/// What cpp-httplib 0.18 (Debian 13) calls otherwise than 0.11 (Debian 12). Its version is a text,
/// which no #if can read: the signatures themselves are asked.
namespace palpa::console {

/// Nothing, or whether there was room in the queue.
using Enqueued = decltype(std::declval<httplib::TaskQueue&>().enqueue(nullptr));

/// A server whose derived class holds the connections itself.
class HttplibServer : public httplib::Server {
 protected:
  /// Reads one request and answers it.
  bool processRequest(httplib::Stream& stream, bool is_last, bool& closed,
                      const std::function<void(httplib::Request&)>& prepare) {
    return process(*this, stream, is_last, closed, prepare);
  }

 private:
  template <class Server, class... Rest>
  static bool process(Server& server, httplib::Stream& stream, Rest&... rest) {
    if constexpr (requires { server.process_request(stream, rest...); }) {
      return server.process_request(stream, rest...);
    } else {
      std::string remote, local;
      int remote_port = 0, local_port = 0;
      stream.get_remote_ip_and_port(remote, remote_port);
      stream.get_local_ip_and_port(local, local_port);
      return server.process_request(stream, remote, remote_port, local, local_port, rest...);
    }
  }
};

}  // namespace palpa::console
