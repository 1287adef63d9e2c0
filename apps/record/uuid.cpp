#include "apps/record/uuid.h"

#include <sys/random.h>

#include <cerrno>

#include "anatomy/geometry/error.h"

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
