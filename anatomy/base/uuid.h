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

namespace palpa::link {

/// RFC 9562 version 5 (SHA-1 of the namespace's 16 bytes and the name): the same name gives the
/// same UUID everywhere, so that what is told twice is stored once. Throws Error for a namespace
/// that is no UUID.
std::string uuidOfName(const std::string& name_space, const std::string& name);

bool isUuid(const std::string& text);  ///< "xxxxxxxx-xxxx-xxxx-xxxx-xxxxxxxxxxxx"

/// Of a trial's statement: the trial's number in the namespace of its session.
std::string statementId(const std::string& session, std::int64_t trial);
/// Of the statement that voids another.
std::string voidingId(const std::string& statement);

}  // namespace palpa::link
