#pragma once

#include <cstdint>
#include <string>

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
