#include "apps/os/tls/tls_client.h"

#include <openssl/ssl.h>

#include "anatomy/base/error.h"
#include "apps/os/tls/openssl.h"

namespace palpa::os {
namespace {

using openssl::must;

void believe(SSL_CTX* context, const std::string& authority) {
  X509_STORE* const store = SSL_CTX_get_cert_store(context);
  const openssl::Bio text = openssl::reader(authority);
  int read = 0;
  for (; const openssl::Certificate one = openssl::nextCertificate(text.get()); ++read)
    must(X509_STORE_add_cert(store, one.get()) == 1, "an authority");
  if (read == 0)
    throw UsageError("is no certificate", "the authority's certificate", "Have it made again");
  SSL_CTX_set_verify(context, SSL_VERIFY_PEER, nullptr);
}

void expect(SSL_CTX* context, const std::string& host) {
  X509_VERIFY_PARAM* const wanted = SSL_CTX_get0_param(context);
  X509_VERIFY_PARAM_set_hostflags(wanted, X509_CHECK_FLAG_NO_PARTIAL_WILDCARDS);
  if (X509_VERIFY_PARAM_set1_ip_asc(wanted, host.c_str()) == 1) return;
  ERR_clear_error();
  must(X509_VERIFY_PARAM_set1_host(wanted, host.c_str(), host.size()) == 1, "the host's name");
}

void show(SSL_CTX* context, const Identity& identity) {
  if (identity.certificate.empty()) return;
  const openssl::Certificate own = openssl::certificateIn(identity.certificate);
  if (!own || !belongTogether(identity) || SSL_CTX_use_certificate(context, own.get()) != 1 ||
      SSL_CTX_use_PrivateKey(context, openssl::keyIn(identity.key).get()) != 1)
    throw UsageError("do not belong together, or cannot be read (" + openssl::trouble() + ")",
                     "certificate and key", "Have them made again");
}

}  // namespace

TlsClient::TlsClient(const TlsTrust& trust) {
  const std::shared_ptr<SSL_CTX> context(SSL_CTX_new(TLS_client_method()),
                                         openssl::Freed<SSL_CTX_free>{});
  must(context && SSL_CTX_set_min_proto_version(context.get(), TLS1_2_VERSION) == 1, "encryption");
  believe(context.get(), trust.authority);
  expect(context.get(), trust.host);
  show(context.get(), trust.identity);
  context_ = context;
}

}  // namespace palpa::os
