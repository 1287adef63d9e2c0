#include "anatomy/base/uuid.h"

#include <sys/random.h>

#include <array>
#include <cerrno>

#include <openssl/evp.h>

#include "anatomy/base/error.h"

namespace palpa::record {

std::string uuidFrom(std::array<std::uint8_t, 16> random) {
  static constexpr char kHex[] = "0123456789abcdef";
  random[6] = static_cast<std::uint8_t>((random[6] & 0x0f) | 0x40);  // version 4
  random[8] = static_cast<std::uint8_t>((random[8] & 0x3f) | 0x80);  // variant of the RFC
  std::string text;
  for (std::size_t i = 0; i < random.size(); ++i) {
    if (i == 4 || i == 6 || i == 8 || i == 10) text += '-';
    text += {kHex[random[i] >> 4], kHex[random[i] & 15]};
  }
  return text;
}

std::string newUuid() {
  std::array<std::uint8_t, 16> random{};
  ssize_t got = 0;
  do {
    got = getrandom(random.data(), random.size(), 0);  // up to 256 bytes come whole
  } while (got < 0 && errno == EINTR);
  if (got != static_cast<ssize_t>(random.size())) {
    throw Error("the system gives no random numbers", "getrandom", "Give the session a UUID");
  }
  return uuidFrom(random);
}

}  // namespace palpa::record

namespace palpa::link {
namespace {

constexpr char kHexDigits[] = "0123456789abcdefABCDEF";

std::string bytesOf(const std::string& uuid) {
  std::string hex;
  for (const char c : uuid)
    if (c != '-') hex += c;
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  return bytes;
}

}  // namespace

bool isUuid(const std::string& text) {
  if (text.size() != 36) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool dash = i == 8 || i == 13 || i == 18 || i == 23;
    if (dash ? text[i] != '-' : std::string(kHexDigits).find(text[i]) == std::string::npos)
      return false;
  }
  return true;
}

std::string uuidOfName(const std::string& name_space, const std::string& name) {
  if (!isUuid(name_space))
    throw Error("is no UUID", "\"" + name_space + "\"",
                "The evidence is damaged or was made by another program: leave this session out");
  const std::string input = bytesOf(name_space) + name;
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  if (EVP_Digest(input.data(), input.size(), digest.data(), &size, EVP_sha1(), nullptr) != 1 ||
      size < 16)
    throw Error("cannot be computed", "SHA-1", "Check the installation of OpenSSL");
  digest[6] = static_cast<unsigned char>((digest[6] & 0x0f) | 0x50);  // version 5
  digest[8] = static_cast<unsigned char>((digest[8] & 0x3f) | 0x80);  // variant of the RFC
  std::string text;
  for (std::size_t i = 0; i < 16; ++i) {
    if (i == 4 || i == 6 || i == 8 || i == 10) text += '-';
    text += {kHexDigits[digest[i] >> 4], kHexDigits[digest[i] & 15]};
  }
  return text;
}

std::string statementId(const std::string& session, std::int64_t trial) {
  return uuidOfName(session, "trial " + std::to_string(trial));
}
std::string voidingId(const std::string& statement) { return uuidOfName(statement, "voided"); }

}  // namespace palpa::link
