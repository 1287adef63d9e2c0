#pragma once

#include <string_view>

namespace palpa::report {

/// What the pages of practice need besides the usual style sheet.
std::string_view progressStyle();

}  // namespace palpa::report
