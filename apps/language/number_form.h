#pragma once

#include <string>
#include <string_view>

namespace palpa::language {

/// How a language writes numbers. Files keep their point; this is for what people read.
struct NumberForm {
  std::string point = ".";  ///< between units and tenths
  std::string group = ",";  ///< between thousands

  bool operator==(const NumberForm&) const = default;
};

/// An English text with its numbers written so: "1,250.5 mm" -> "1.250,5 mm". Only numbers that
/// stand alone: no versions (1.2.3), no addresses, no names of files.
std::string numbersIn(std::string_view english, const NumberForm& form);

}  // namespace palpa::language
