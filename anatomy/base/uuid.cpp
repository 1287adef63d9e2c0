#include "anatomy/base/uuid.h"

#include <openssl/rand.h>

#include <algorithm>
#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/string_generator.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <string_view>

#include "anatomy/base/error.h"

namespace palpa {

bool isUuid(const std::string& text) {
  constexpr std::string_view kHexDigits = "0123456789abcdefABCDEF";
  if (text.size() != 36) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool dash = i == 8 || i == 13 || i == 18 || i == 23;
    if (dash ? text[i] != '-' : kHexDigits.find(text[i]) == std::string_view::npos) return false;
  }
  return true;
}

std::string uuidFrom(std::array<std::uint8_t, 16> random) {
  random[6] = static_cast<std::uint8_t>((random[6] & 0x0f) | 0x40);  // version 4
  random[8] = static_cast<std::uint8_t>((random[8] & 0x3f) | 0x80);  // variant of the RFC
  boost::uuids::uuid uuid;
  std::copy(random.begin(), random.end(), uuid.begin());
  return to_string(uuid);
}

std::string newUuid() {
  std::array<std::uint8_t, 16> random{};
  if (RAND_bytes(random.data(), static_cast<int>(random.size())) != 1)
    throw Error("the system gives no random numbers", "RAND_bytes", "Give the session a UUID");
  return uuidFrom(random);
}

std::string uuidOfName(const std::string& name_space, const std::string& name) {
  if (!isUuid(name_space))
    throw Error("is not a UUID", "\"" + name_space + "\"",
                "The evidence is damaged or was made by another program: leave this session out");
  const boost::uuids::name_generator_sha1 named(boost::uuids::string_generator()(name_space));
  return to_string(named(name));
}

}  // namespace palpa
