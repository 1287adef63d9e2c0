#pragma once

#include <string>
#include <string_view>

#include "apps/report/html.h"

namespace palpa::report {

/// A penalty code in the words of a clinical teacher.
struct Code {
  std::string_view code, unit, meaning;
};

/// Unit of a penalty's value; "" for unknown codes.
std::string_view unitOf(const std::string& code);

/// "What these numbers mean", with the source.
void writeGlossary(Html& html);

}  // namespace palpa::report
