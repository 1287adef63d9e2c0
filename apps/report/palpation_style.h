#pragma once

#include <string_view>

namespace palpa::report {

/// What a page of palpation needs beside the style sheet of all pages; its colours are that one's.
std::string_view palpationStyle();

}  // namespace palpa::report
