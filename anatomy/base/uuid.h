#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace palpa {

bool isUuid(const std::string& text);  ///< "xxxxxxxx-xxxx-xxxx-xxxx-xxxxxxxxxxxx"

/// RFC 9562 version 4 from 16 random bytes: "xxxxxxxx-xxxx-4xxx-yxxx-xxxxxxxxxxxx".
std::string uuidFrom(std::array<std::uint8_t, 16> random);

/// A new one, from random numbers of the system. Only names a session; no result depends on it.
std::string newUuid();

/// RFC 9562 version 5 (SHA-1 of the namespace's 16 bytes and the name): the same name gives the
/// same UUID everywhere. Throws Error for a namespace that is no UUID.
std::string uuidOfName(const std::string& name_space, const std::string& name);

}  // namespace palpa
