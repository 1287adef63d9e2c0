#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace palpa::record {

/// RFC 9562 version 4 from 16 random bytes: "xxxxxxxx-xxxx-4xxx-yxxx-xxxxxxxxxxxx".
std::string uuidFrom(std::array<std::uint8_t, 16> random);

/// A new one, from the kernel's random numbers. Only names a session; no result depends on it.
std::string newUuid();

}  // namespace palpa::record
