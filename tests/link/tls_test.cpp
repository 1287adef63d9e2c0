// Over a protected connection: only with the computer that was meant.
#include <gtest/gtest.h>
#include <httplib.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <thread>

#include "apps/link/lrs_client.h"
#include "apps/runtime/clock.h"
#include "tests/support/files.h"

namespace palpa::link {
namespace {

using Key = std::unique_ptr<EVP_PKEY, void (*)(EVP_PKEY*)>;
using Certificate = std::unique_ptr<X509, void (*)(X509*)>;

void addExtension(X509* certificate, int kind, const char* value) {
  X509_EXTENSION* extension = X509V3_EXT_conf_nid(nullptr, nullptr, kind, value);
  X509_add_ext(certificate, extension, -1);
  X509_EXTENSION_free(extension);
}

Certificate certificateFor(EVP_PKEY* key, const char* computer) {
  Certificate certificate(X509_new(), X509_free);
  X509* c = certificate.get();
  X509_set_version(c, 2);
  ASN1_INTEGER_set(X509_get_serialNumber(c), 1);
  ASN1_TIME_set_string(X509_getm_notBefore(c), "20200101000000Z");
  ASN1_TIME_set_string(X509_getm_notAfter(c), "20991231000000Z");
  X509_set_pubkey(c, key);
  X509_NAME_add_entry_by_txt(X509_get_subject_name(c), "CN", MBSTRING_ASC,
                             reinterpret_cast<const unsigned char*>("test"), -1, -1, 0);
  X509_set_issuer_name(c, X509_get_subject_name(c));
  addExtension(c, NID_basic_constraints, "critical,CA:TRUE");
  addExtension(c, NID_subject_alt_name, computer);
  X509_sign(c, key, EVP_sha256());
  return certificate;
}

template <class Write>
std::string pem(const std::filesystem::path& file, Write write) {
  std::FILE* stream = std::fopen(file.c_str(), "w");
  write(stream);
  std::fclose(stream);
  return file.string();
}

/// Confirms whatever it is sent.
class ProtectedServer {
 public:
  ProtectedServer(const std::filesystem::path& folder, const char* computer) {
    const Key key(EVP_EC_gen("P-256"), EVP_PKEY_free);
    const Certificate certificate = certificateFor(key.get(), computer);
    certificate_file = pem(folder / "certificate.pem",
                           [&](std::FILE* f) { PEM_write_X509(f, certificate.get()); });
    const std::string key_file = pem(folder / "key.pem", [&](std::FILE* f) {
      PEM_write_PrivateKey(f, key.get(), nullptr, nullptr, 0, nullptr, nullptr);
    });
    server_ = std::make_unique<httplib::SSLServer>(certificate_file.c_str(), key_file.c_str());
    server_->Put("/statements", [this](const httplib::Request&, httplib::Response& response) {
      ++asked;
      response.set_header("X-Experience-API-Version", "1.0.3");
      response.status = 204;
    });
    port_ = server_->bind_to_any_port("127.0.0.1");
    thread_ = std::thread([this] { server_->listen_after_bind(); });
    while (!server_->is_running()) runtime::SteadyClock().sleepUntil(runtime::kMillisecond);
  }
  ~ProtectedServer() {
    server_->stop();
    thread_.join();
  }
  ProtectedServer(const ProtectedServer&) = delete;
  ProtectedServer& operator=(const ProtectedServer&) = delete;

  LrsAnswer answer() const {
    LrsClient client(endpointOf("https://127.0.0.1:" + std::to_string(port_), false),
                     {"teacher", "secret"}, {5, 5});
    return client.put("0a1b2c3d-4e5f-4a6b-8c7d-000000000001", "{}");
  }

  std::string certificate_file;
  std::atomic<int> asked{0};

 private:
  std::unique_ptr<httplib::SSLServer> server_;
  std::thread thread_;
  int port_ = 0;
};

class Tls : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        test::freshFolder("link", testing::UnitTest::GetInstance()->current_test_info()->name());
  }
  void TearDown() override { ::unsetenv("SSL_CERT_FILE"); }
  std::filesystem::path folder_;
};

TEST_F(Tls, AnUnknownCertificateIsNotTrusted) {
  const ProtectedServer server(folder_, "IP:127.0.0.1");
  const LrsAnswer answer = server.answer();
  EXPECT_EQ(answer.status, 0);
  EXPECT_EQ(answer.trouble, "its certificate is not trusted, or is another computer's");
  EXPECT_EQ(server.asked, 0);
}

TEST_F(Tls, ACentresOwnIsTrustedWhenNamed) {
  const ProtectedServer server(folder_, "IP:127.0.0.1");
  ::setenv("SSL_CERT_FILE", server.certificate_file.c_str(), 1);
  EXPECT_EQ(server.answer().status, 204);
}

TEST_F(Tls, AnotherComputersIsNot) {
  const ProtectedServer server(folder_, "DNS:lrs.example");
  ::setenv("SSL_CERT_FILE", server.certificate_file.c_str(), 1);
  EXPECT_EQ(server.answer().status, 0);
  EXPECT_EQ(server.asked, 0);
}

}  // namespace
}  // namespace palpa::link
