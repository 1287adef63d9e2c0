#pragma once

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

#include <memory>
#include <string>
#include <string_view>

#include "anatomy/base/error.h"

/// OpenSSL's objects, freed by whoever holds them.
namespace palpa::os::openssl {

template <auto kFree>
struct Freed {
  template <class T>
  void operator()(T* object) const {
    kFree(object);
  }
};
using Bio = std::unique_ptr<BIO, Freed<BIO_free_all>>;
using Key = std::unique_ptr<EVP_PKEY, Freed<EVP_PKEY_free>>;
using Certificate = std::unique_ptr<X509, Freed<X509_free>>;

/// What went wrong last on this thread, in OpenSSL's words; they are forgotten.
inline std::string trouble() {
  const unsigned long code = ERR_peek_last_error();
  ERR_clear_error();
  const char* const words = code == 0 ? nullptr : ERR_reason_error_string(code);
  return words ? words : "no reason given";
}

/// Throws Error with `trouble` unless `went_well`.
inline void must(bool went_well, const char* what) {
  if (!went_well)
    throw Error("was refused by OpenSSL (" + trouble() + ")", what,
                "Look whether this computer's OpenSSL is complete");
}

inline Bio reader(std::string_view text) {
  return Bio(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}

/// Null where there is no further one.
inline Certificate nextCertificate(BIO* text) {
  Certificate found(PEM_read_bio_X509(text, nullptr, nullptr, nullptr));
  ERR_clear_error();
  return found;
}

/// The first of a text; null where it holds none.
inline Certificate certificateIn(const std::string& pem) {
  return nextCertificate(reader(pem).get());
}

/// A key behind a password is none: a server that starts by itself can ask nobody.
inline Key keyIn(const std::string& pem) {
  const auto no_password = [](char*, int, int, void*) { return 0; };
  Key found(PEM_read_bio_PrivateKey(reader(pem).get(), nullptr, no_password, nullptr));
  ERR_clear_error();
  return found;
}

}  // namespace palpa::os::openssl
