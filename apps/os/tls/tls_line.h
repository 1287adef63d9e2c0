#pragma once

#include <memory>
#include <string>

#include "apps/os/socket.h"
#include "apps/os/tls/certificates.h"

namespace palpa::os {

/// The server's side of encrypted lines (TLS 1.2 and 1.3, by OpenSSL), with one identity.
class TlsServer {
 public:
  /// Throws UsageError where certificate and key are none, or do not belong together.
  explicit TlsServer(const Identity& identity);
  ~TlsServer();

  /// Over a connection that was accepted and never waits. The two ends agree on keys while the
  /// first bytes are received, a step each time; until then nothing can be sent. Whoever does not
  /// speak TLS is told so in a sentence, as HTTP, and is gone then. Any thread; a line belongs to
  /// one at a time.
  std::unique_ptr<Line> lineOver(int socket) const;

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

}  // namespace palpa::os
