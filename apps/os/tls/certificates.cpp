#include "apps/os/tls/certificates.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <openssl/asn1.h>
#include <openssl/bn.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/x509_vfy.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <memory>

#include "anatomy/base/error.h"
#include "apps/os/tls/openssl.h"

namespace palpa::os {
namespace {

using openssl::must;
using BigNumber = std::unique_ptr<BIGNUM, openssl::Freed<BN_free>>;
using Extension = std::unique_ptr<X509_EXTENSION, openssl::Freed<X509_EXTENSION_free>>;
using OtherNames = std::unique_ptr<GENERAL_NAMES, openssl::Freed<GENERAL_NAMES_free>>;
using Store = std::unique_ptr<X509_STORE, openssl::Freed<X509_STORE_free>>;
using Check = std::unique_ptr<X509_STORE_CTX, openssl::Freed<X509_STORE_CTX_free>>;

constexpr int kSerialBits = 127;                // drawn, never counted: no two are alike
constexpr std::chrono::hours kClocksApart{24};  // a tablet's may be behind
constexpr std::size_t kLongestName = 64;        // of a common name

std::string pemOf(const auto& write) {
  const openssl::Bio text(BIO_new(BIO_s_mem()));
  must(text && write(text.get()) == 1, "a certificate's text");
  char* bytes = nullptr;
  const long size = BIO_get_mem_data(text.get(), &bytes);
  return {bytes, static_cast<std::size_t>(size)};
}

std::string certificateText(X509* certificate) {
  return pemOf([&](BIO* to) { return PEM_write_bio_X509(to, certificate); });
}

std::string keyText(EVP_PKEY* key) {
  return pemOf([&](BIO* to) {
    return PEM_write_bio_PrivateKey(to, key, nullptr, nullptr, 0, nullptr, nullptr);
  });
}

/// In its usual form; empty: it is none.
std::string addressIn(const std::string& name) {
  std::array<unsigned char, sizeof(in6_addr)> bytes{};
  std::array<char, INET6_ADDRSTRLEN> text{};
  for (const int family : {AF_INET, AF_INET6})
    if (::inet_pton(family, name.c_str(), bytes.data()) == 1 &&
        ::inet_ntop(family, bytes.data(), text.data(), text.size()))
      return text.data();
  return "";
}

constexpr char kWithinAHouse[] =
    "critical,permitted;DNS:local,permitted;DNS:localhost,permitted;IP:127.0.0.0/255.0.0.0,"
    "permitted;IP:10.0.0.0/255.0.0.0,permitted;IP:172.16.0.0/255.240.0.0,"
    "permitted;IP:192.168.0.0/255.255.0.0,permitted;IP:169.254.0.0/255.255.0.0,"
    "permitted;IP:::1/ffff:ffff:ffff:ffff:ffff:ffff:ffff:ffff,permitted;IP:fc00::/fe00::,"
    "permitted;IP:fe80::/ffc0::";

/// Beside what lies within a house: these.
std::string constraintsFor(const std::vector<std::string>& names) {
  std::string text = kWithinAHouse;
  for (const std::string& wished : names) {
    const std::string name = usualForm(wished), address = addressIn(name);
    text += ",permitted;";
    if (address.empty())
      text += "DNS:" + name;
    else
      text += "IP:" + name +
              (address.find(':') == std::string::npos ? "/255.255.255.255"
                                                      : "/ffff:ffff:ffff:ffff:ffff:ffff:ffff:ffff");
  }
  return text;
}

/// A comma or a line's end would begin another name.
void checkName(const std::string& name) {
  const auto fits = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' ||
           c == '.' || c == ':' || c == '_';
  };
  if (name.empty() || !std::all_of(name.begin(), name.end(), fits))
    throw UsageError("is no name of a computer", "\"" + name + "\"",
                     "Letters, digits, points and hyphens; or an address in figures");
}

std::string otherNames(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& wished : names) {
    const std::string name = usualForm(wished);
    text +=
        (text.empty() ? "" : ",") + std::string(addressIn(name).empty() ? "DNS:" : "IP:") + name;
  }
  return text;
}

void extend(X509* certificate, X509* issuer, int kind, const std::string& value) {
  X509V3_CTX context;
  X509V3_set_ctx(&context, issuer, certificate, nullptr, nullptr, 0);
  const Extension extension(X509V3_EXT_conf_nid(nullptr, &context, kind, value.c_str()));
  must(extension && X509_add_ext(certificate, extension.get(), -1) == 1, "a part of a certificate");
}

void callIt(X509_NAME* name, const std::string& words) {
  if (words.empty() || words.size() > kLongestName)
    throw UsageError("is not 1 to 64 bytes long", "a certificate's name \"" + words + "\"",
                     "Choose a shorter name");
  must(X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_UTF8,
                                  reinterpret_cast<const unsigned char*>(words.data()),
                                  static_cast<int>(words.size()), -1, 0) == 1,
       "a certificate's name");
}

std::time_t timeOf(std::chrono::sys_seconds moment) { return moment.time_since_epoch().count(); }

void setTimes(X509* certificate, std::chrono::sys_seconds now, std::chrono::days lasts) {
  must(ASN1_TIME_set(X509_getm_notBefore(certificate), timeOf(now - kClocksApart)) &&
           ASN1_TIME_set(X509_getm_notAfter(certificate), timeOf(now + lasts)),
       "a certificate's times");
}

void number(X509* certificate) {
  const BigNumber drawn(BN_new());
  must(drawn && BN_rand(drawn.get(), kSerialBits, BN_RAND_TOP_ONE, BN_RAND_BOTTOM_ANY) == 1 &&
           BN_to_ASN1_INTEGER(drawn.get(), X509_get_serialNumber(certificate)),
       "a certificate's number");
}

struct Blank {
  openssl::Key key;
  openssl::Certificate certificate;
};

Blank blankFor(const std::string& name, std::chrono::sys_seconds now, std::chrono::days lasts) {
  Blank blank{openssl::Key(EVP_EC_gen("P-256")), openssl::Certificate(X509_new())};
  must(blank.key && blank.certificate && X509_set_version(blank.certificate.get(), 2) == 1,
       "a new key");
  number(blank.certificate.get());
  setTimes(blank.certificate.get(), now, lasts);
  callIt(X509_get_subject_name(blank.certificate.get()), name);
  must(X509_set_pubkey(blank.certificate.get(), blank.key.get()) == 1, "a new key");
  return blank;
}

Identity signedBy(const Blank& blank, EVP_PKEY* key) {
  must(X509_sign(blank.certificate.get(), key, EVP_sha256()) > 0, "a signature");
  return {certificateText(blank.certificate.get()), keyText(blank.key.get())};
}

std::string commonName(const X509_NAME* name) {
  std::array<char, 4 * kLongestName> text{};
  const int size = X509_NAME_get_text_by_NID(const_cast<X509_NAME*>(name), NID_commonName,
                                             text.data(), static_cast<int>(text.size()));
  return {text.data(), static_cast<std::size_t>(std::max(size, 0))};
}

std::chrono::sys_seconds momentOf(const ASN1_TIME* time) {
  std::tm parts{};
  must(ASN1_TIME_to_tm(time, &parts) == 1, "a certificate's times");
  return std::chrono::sys_seconds(std::chrono::seconds(::timegm(&parts)));
}

std::string addressOf(const ASN1_OCTET_STRING* bytes) {
  constexpr int kShort = 4;  // bytes of IPv4; else of IPv6
  std::array<char, INET6_ADDRSTRLEN> text{};
  const int family = ASN1_STRING_length(bytes) == kShort ? AF_INET : AF_INET6;
  const char* const written =
      ::inet_ntop(family, ASN1_STRING_get0_data(bytes), text.data(), text.size());
  return written ? written : "";
}

std::vector<std::string> otherNamesOf(X509* certificate) {
  std::vector<std::string> names;
  const OtherNames all(static_cast<GENERAL_NAMES*>(
      X509_get_ext_d2i(certificate, NID_subject_alt_name, nullptr, nullptr)));
  for (int i = 0; all && i < sk_GENERAL_NAME_num(all.get()); ++i) {
    const GENERAL_NAME* one = sk_GENERAL_NAME_value(all.get(), i);
    if (one->type == GEN_DNS)
      names.emplace_back(reinterpret_cast<const char*>(ASN1_STRING_get0_data(one->d.dNSName)),
                         static_cast<std::size_t>(ASN1_STRING_length(one->d.dNSName)));
    if (one->type == GEN_IPADD) names.push_back(addressOf(one->d.iPAddress));
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string fingerprintOf(const X509* certificate) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
  unsigned size = 0;
  must(X509_digest(certificate, EVP_sha256(), bytes.data(), &size) == 1, "a fingerprint");
  std::string text;
  char part[4];
  for (unsigned i = 0; i < size; ++i) {
    std::snprintf(part, sizeof part, "%s%02X", i == 0 ? "" : ":", bytes[i]);
    text += part;
  }
  return text;
}

}  // namespace

std::string usualForm(const std::string& name) {
  checkName(name);
  if (std::string address = addressIn(name); !address.empty()) return address;
  std::string small = name;
  for (char& c : small)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return small;
}

Identity makeAuthority(const std::string& name, const std::vector<std::string>& also_for,
                       std::chrono::days lasts, std::chrono::sys_seconds now) {
  const Blank blank = blankFor(name, now, lasts);
  X509* const own = blank.certificate.get();
  must(X509_set_issuer_name(own, X509_get_subject_name(own)) == 1, "an authority");
  extend(own, own, NID_basic_constraints, "critical,CA:TRUE,pathlen:0");
  extend(own, own, NID_key_usage, "critical,keyCertSign,cRLSign");
  extend(own, own, NID_name_constraints, constraintsFor(also_for));
  extend(own, own, NID_subject_key_identifier, "hash");
  return signedBy(blank, blank.key.get());
}

Identity makeIdentity(const IdentityWish& wish, const Identity& authority,
                      std::chrono::sys_seconds now) {
  const openssl::Certificate issuer = openssl::certificateIn(authority.certificate);
  const openssl::Key key = openssl::keyIn(authority.key);
  must(issuer && key, "the authority's own certificate");
  const Blank blank = blankFor(wish.name, now, wish.lasts);
  X509* const own = blank.certificate.get();
  must(X509_set_issuer_name(own, X509_get_subject_name(issuer.get())) == 1, "an identity");
  extend(own, issuer.get(), NID_basic_constraints, "critical,CA:FALSE");
  extend(own, issuer.get(), NID_key_usage, "critical,digitalSignature");
  extend(own, issuer.get(), NID_ext_key_usage,
         wish.purpose == Purpose::server ? "serverAuth" : "clientAuth");
  extend(own, issuer.get(), NID_subject_key_identifier, "hash");
  extend(own, issuer.get(), NID_authority_key_identifier, "keyid:always");
  if (!wish.reached_by.empty())
    extend(own, issuer.get(), NID_subject_alt_name, otherNames(wish.reached_by));
  return signedBy(blank, key.get());
}

CertificateFacts factsOf(const std::string& certificate, const std::string& where) {
  const openssl::Certificate read = openssl::certificateIn(certificate);
  if (!read)
    throw UsageError("holds no certificate", where,
                     "A PEM file is needed: -----BEGIN CERTIFICATE-----");
  return {commonName(X509_get_subject_name(read.get())),
          commonName(X509_get_issuer_name(read.get())),
          otherNamesOf(read.get()),
          momentOf(X509_get0_notBefore(read.get())),
          momentOf(X509_get0_notAfter(read.get())),
          fingerprintOf(read.get())};
}

bool belongTogether(const Identity& identity) {
  const openssl::Certificate certificate = openssl::certificateIn(identity.certificate);
  const openssl::Key key = openssl::keyIn(identity.key);
  const bool together =
      certificate && key && X509_check_private_key(certificate.get(), key.get()) == 1;
  ERR_clear_error();
  return together;
}

bool isVouchedFor(const std::string& certificate, const std::string& authority,
                  std::chrono::sys_seconds now) {
  const openssl::Certificate read = openssl::certificateIn(certificate),
                             issuer = openssl::certificateIn(authority);
  const Store store(X509_STORE_new());
  const Check check(X509_STORE_CTX_new());
  if (!read || !issuer || !store || !check) return false;
  bool valid = X509_STORE_add_cert(store.get(), issuer.get()) == 1 &&
               X509_STORE_CTX_init(check.get(), store.get(), read.get(), nullptr) == 1;
  if (valid) X509_STORE_CTX_set_time(check.get(), 0, timeOf(now));
  valid = valid && X509_verify_cert(check.get()) == 1;
  ERR_clear_error();
  return valid;
}

}  // namespace palpa::os
