#include "apps/os/tls/tls_line.h"

#include <openssl/err.h>
#include <openssl/ssl.h>

#include <algorithm>
#include <climits>
#include <memory>
#include <mutex>
#include <string_view>

#include "anatomy/base/error.h"
#include "apps/os/tls/openssl.h"

namespace palpa::os {
namespace {

using openssl::must;
using Connection = std::unique_ptr<SSL, openssl::Freed<SSL_free>>;

constexpr std::string_view kPlain =
    "HTTP/1.1 400 Bad Request\r\nContent-Type: text/plain\r\nConnection: close\r\n"
    "Content-Length: 50\r\n\r\nThis address is encrypted: begin it with https://\n";

int countFor(std::size_t size) { return static_cast<int>(std::min<std::size_t>(size, INT_MAX)); }

/// OpenSSL's bytes go by our own calls: they never wait, and a connection that breaks ends no
/// program.
int write(BIO* bio, const char* bytes, int size) {
  BIO_clear_retry_flags(bio);
  const auto* line = static_cast<const Line*>(BIO_get_data(bio));
  const auto sent = os::sendSome(line->socket(), bytes, static_cast<std::size_t>(size));
  if (sent && *sent == 0) BIO_set_retry_write(bio);
  return sent && *sent > 0 ? static_cast<int>(*sent) : -1;
}

int read(BIO* bio, char* bytes, int size) {
  BIO_clear_retry_flags(bio);
  const auto* line = static_cast<const Line*>(BIO_get_data(bio));
  const auto got = os::receiveSome(line->socket(), bytes, static_cast<std::size_t>(size));
  if (!got) return 0;
  if (*got == 0) BIO_set_retry_read(bio);
  return *got > 0 ? static_cast<int>(*got) : -1;
}

long control(BIO*, int what, long, void*) { return what == BIO_CTRL_FLUSH ? 1 : 0; }

/// One for the program, never freed: lines may outlive everything else.
BIO_METHOD* overSockets() {
  static BIO_METHOD* const method = [] {
    BIO_METHOD* const made = BIO_meth_new(BIO_get_new_index() | BIO_TYPE_SOURCE_SINK, "socket");
    must(made && BIO_meth_set_write(made, write) == 1 && BIO_meth_set_read(made, read) == 1 &&
             BIO_meth_set_ctrl(made, control) == 1,
         "a connection");
    return made;
  }();
  return method;
}

class TlsLine final : public Line {
 public:
  TlsLine(int socket, SSL_CTX* context) : Line(socket), ssl_(SSL_new(context)) {
    openssl::Bio bio(BIO_new(overSockets()));
    must(ssl_ && bio, "a connection");
    BIO_set_data(bio.get(), static_cast<Line*>(this));
    BIO_set_init(bio.get(), 1);
    SSL_set_bio(ssl_.get(), bio.get(), bio.get());
    static_cast<void>(bio.release());  // the connection's now
    SSL_set_accept_state(ssl_.get());
  }
  ~TlsLine() override { sayGoodbye(); }

  std::optional<std::size_t> sendSome(const void* bytes, std::size_t size) override {
    if (size == 0 || !understood()) return 0;
    ERR_clear_error();
    return countOf(SSL_write(ssl_.get(), bytes, countFor(size)));
  }
  std::optional<std::size_t> receiveSome(void* bytes, std::size_t size) override {
    ERR_clear_error();
    return countOf(SSL_read(ssl_.get(), bytes, countFor(size)));
  }
  bool holdsMore() const override { return SSL_pending(ssl_.get()) > 0; }
  bool greets() const override {
    return BIO_number_read(SSL_get_rbio(ssl_.get())) > 0 && !understood() && !broken_;
  }
  void endWriting() override {
    sayGoodbye();
    Line::endWriting();
  }

 private:
  /// Once is for ever: new keys are agreed on while both go on talking.
  bool understood() const {
    understood_ = understood_ || SSL_is_init_finished(ssl_.get()) == 1;
    return understood_;
  }
  std::optional<std::size_t> countOf(int result) {
    if (result > 0) return static_cast<std::size_t>(result);
    const int why = SSL_get_error(ssl_.get(), result);
    if (why == SSL_ERROR_WANT_READ || why == SSL_ERROR_WANT_WRITE) return 0;
    broken_ = why == SSL_ERROR_SSL || why == SSL_ERROR_SYSCALL;
    if (ERR_GET_REASON(ERR_peek_error()) == SSL_R_HTTP_REQUEST) sayThatItIsEncrypted();
    ERR_clear_error();
    return std::nullopt;
  }
  /// What is left unread would take the words with it; who says more than a request is not waited
  /// for.
  void sayThatItIsEncrypted() {
    os::sendSome(socket(), kPlain.data(), kPlain.size());
    Line::endWriting();
    char rest[16384];
    os::receiveSome(socket(), rest, sizeof rest);
  }
  /// So that the other side can tell an end from a cut. Once, and not on a line that broke.
  void sayGoodbye() {
    if (!broken_ && understood() && (SSL_get_shutdown(ssl_.get()) & SSL_SENT_SHUTDOWN) == 0)
      SSL_shutdown(ssl_.get());
    ERR_clear_error();
  }

  const Connection ssl_;
  bool broken_ = false;
  mutable bool understood_ = false;
};

using Context = std::shared_ptr<SSL_CTX>;

/// As many as the text says that it holds.
int certificatesIn(std::string_view text) {
  constexpr std::string_view kBegin = "-----BEGIN CERTIFICATE-----";
  int count = 0;
  for (std::size_t at = 0; (at = text.find(kBegin, at)) != std::string_view::npos; ++count)
    at += kBegin.size();
  return count;
}

/// One piece of work a call, of curves that cost little: whoever greets decides neither how long a
/// greeting takes nor how often keys are made anew within one call.
Context contextFor(const Identity& identity) {
  Context context(SSL_CTX_new(TLS_server_method()), openssl::Freed<SSL_CTX_free>{});
  SSL_CTX* const ssl = context.get();
  must(ssl && SSL_CTX_set_min_proto_version(ssl, TLS1_2_VERSION) == 1 &&
           SSL_CTX_set1_groups_list(ssl, "X25519:P-256") == 1,
       "encryption");
  SSL_CTX_set_options(ssl, SSL_OP_NO_RENEGOTIATION | SSL_OP_CIPHER_SERVER_PREFERENCE);
  SSL_CTX_set_mode(ssl, SSL_MODE_ENABLE_PARTIAL_WRITE | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER |
                            SSL_MODE_RELEASE_BUFFERS);
  SSL_CTX_clear_mode(ssl, SSL_MODE_AUTO_RETRY);
  SSL_CTX_set_session_cache_mode(ssl, SSL_SESS_CACHE_OFF);
  const openssl::Bio chain = openssl::reader(identity.certificate);
  const openssl::Certificate own = openssl::nextCertificate(chain.get());
  if (!own || !belongTogether(identity) || SSL_CTX_use_certificate(ssl, own.get()) != 1 ||
      SSL_CTX_use_PrivateKey(ssl, openssl::keyIn(identity.key).get()) != 1)
    throw UsageError(
        "do not belong together, are none, or are too weak (" + openssl::trouble() + ")",
        "certificate and key",
        "Give the key that the certificate was made for, without a password, as PEM");
  int read = 1;
  for (; const openssl::Certificate above = openssl::nextCertificate(chain.get()); ++read)
    must(SSL_CTX_add1_chain_cert(ssl, above.get()) == 1, "the certificate's chain");
  if (read < certificatesIn(identity.certificate))
    throw UsageError("holds one that cannot be read", "the certificate's chain",
                     "Put the file together again: the certificate, then those above it");
  return context;
}

}  // namespace

struct TlsServer::Now {
  std::mutex mutex;
  Context context;
};

TlsServer::TlsServer(const Identity& identity) : now_(std::make_unique<Now>()) { use(identity); }

TlsServer::~TlsServer() = default;

void TlsServer::use(const Identity& identity) {
  Context context = contextFor(identity);
  const std::lock_guard lock(now_->mutex);
  now_->context = std::move(context);
}

std::unique_ptr<Line> TlsServer::lineOver(int socket) const {
  const std::lock_guard lock(now_->mutex);
  return std::make_unique<TlsLine>(socket, now_->context.get());
}

}  // namespace palpa::os
