#include "anatomy/base/sha256.h"

#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <iterator>

#include "anatomy/base/error.h"

namespace palpa::station {

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
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw UsageError("cannot be read", file.string(), "Check the path");
  return sha256(std::string{std::istreambuf_iterator<char>(stream), {}});
}

}  // namespace palpa::station
