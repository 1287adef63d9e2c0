#include "anatomy/base/sha256.h"

#include <openssl/evp.h>

#include <array>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"

namespace palpa {
namespace {

std::string inHex(const unsigned char* bytes, std::size_t size) {
  std::string hex;
  for (std::size_t i = 0; i < size; ++i) {
    hex += "0123456789abcdef"[bytes[i] >> 4];
    hex += "0123456789abcdef"[bytes[i] & 15];
  }
  return hex;
}

[[noreturn]] void failWithoutHash() {
  throw Error("SHA-256 is not available", "OpenSSL", "Reinstall libssl");
}

}  // namespace

std::string sha256(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1)
    failWithoutHash();
  return inHex(digest.data(), size);
}

std::string slowSha256(std::string_view text, std::string_view salt, int rounds) {
  std::array<unsigned char, 32> key{};
  if (PKCS5_PBKDF2_HMAC(text.data(), static_cast<int>(text.size()),
                        reinterpret_cast<const unsigned char*>(salt.data()),
                        static_cast<int>(salt.size()), rounds, EVP_sha256(),
                        static_cast<int>(key.size()), key.data()) != 1)
    failWithoutHash();
  return inHex(key.data(), key.size());
}

std::string sha256OfFile(const std::filesystem::path& file) {
  const std::optional<std::string> bytes = readWhole(file);
  if (!bytes) throw UsageError("cannot be read", file.string(), "Check the path");
  return sha256(*bytes);
}

}  // namespace palpa
