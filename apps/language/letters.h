#pragma once

#include <string>

namespace palpa::language {

/// A UTF-8 text with a capital first letter, or without one: Latin and Greek; others have none.
std::string withCapital(const std::string& text);
std::string withoutCapital(const std::string& text);

}  // namespace palpa::language
