#pragma once

#include <memory>
#include <string>

#include "apps/os/tls/certificates.h"

namespace palpa::os {

/// Whom a client takes the other end for, and who it says that it is itself.
struct TlsTrust {
  std::string authority;      ///< PEM: whoever it vouches for is believed, and nobody else
  std::string host;           ///< the name or address that the other end's certificate must have
  Identity identity{"", ""};  ///< shown to the other end; empty: none
};

/// The client's side of encrypted lines, for libraries that speak TLS by OpenSSL themselves (MQTT,
/// HTTPS): TLS 1.2 or later, nothing from files, no authority of the system's.
class TlsClient {
 public:
  /// Throws UsageError where a text is no certificate or no key, or the two do not belong together.
  explicit TlsClient(const TlsTrust& trust);
  /// OpenSSL's SSL_CTX; it lives as long as this, and as those who hold it.
  void* context() const { return context_.get(); }

 private:
  std::shared_ptr<void> context_;
};

}  // namespace palpa::os
