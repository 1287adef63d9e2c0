#pragma once

#include <memory>
#include <string>

#include "apps/os/socket.h"
#include "apps/os/tls/certificates.h"

namespace palpa::os {

/// The server's side of encrypted lines (TLS 1.2 and 1.3, by OpenSSL), with one identity.
class TlsServer {
 public:
  /// Throws UsageError where certificate and key are none, too weak, or do not belong together.
  explicit TlsServer(const Identity& identity);
  ~TlsServer();
  /// From now on for new lines; those there are keep theirs. Any thread. Throws as above.
  void use(const Identity& identity);

  /// Over a connection that was accepted and never waits. The two ends agree on keys while the
  /// first bytes are received, a step each time; until then nothing can be sent. Whoever begins
  /// with plain HTTP (GET, HEAD, POST, PUT) is told so in a sentence, and is gone then. Any thread;
  /// a line belongs to one at a time. Throws Error where there is no memory left for it.
  std::unique_ptr<Line> lineOver(int socket) const;

 private:
  struct Now;
  std::unique_ptr<Now> now_;
};

}  // namespace palpa::os
