#pragma once

#include <string>

namespace palpa {

/// A text as a field of a CSV, RFC 4180: quoted only where needed, quotes doubled.
std::string csvField(const std::string& text);

}  // namespace palpa
