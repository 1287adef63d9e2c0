#include "anatomy/base/sha256.h"

#include <openssl/evp.h>

#include <array>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"

namespace palpa {

std::string sha256(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1)
    throw Error("SHA-256 is not available", "OpenSSL", "Reinstall libssl");
  std::string hex;
  for (unsigned i = 0; i < size; ++i) {
    hex += "0123456789abcdef"[digest[i] >> 4];
    hex += "0123456789abcdef"[digest[i] & 15];
  }
  return hex;
}

std::string sha256OfFile(const std::filesystem::path& file) {
  const std::optional<std::string> bytes = readWhole(file);
  if (!bytes) throw UsageError("cannot be read", file.string(), "Check the path");
  return sha256(*bytes);
}

}  // namespace palpa
