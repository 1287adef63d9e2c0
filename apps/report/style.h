#pragma once

#include <string>

namespace palpa::report {

/// The page's style sheet: light, dark, telephone, paper.
std::string styleSheet();

}  // namespace palpa::report
