#pragma once

#include <string>
#include <vector>

#include "source_tree.h"

namespace palpa::house {

/// A word that makes a result irreproducible, or that does not belong into the project.
struct Forbidden {
  std::string word;
  std::string reason;
  bool code_only = true;                ///< only in .h and .cpp, comments apart
  std::vector<std::string> allowed_in;  ///< files where it is at home
};

const std::vector<Forbidden>& forbidden();

/// Every forbidden word of `file`, in words. A word that begins or ends with a letter is found only
/// as a whole word.
std::vector<std::string> forbiddenWords(const SourceFile& file);

}  // namespace palpa::house
