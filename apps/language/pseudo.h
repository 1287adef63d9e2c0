#pragma once

#include <vector>

#include "apps/language/po_file.h"

namespace palpa::language {

inline constexpr char kPseudo[] = "qps", kPseudoFromRight[] = "qps-rtl";

/// Each message in a language that nobody speaks: every letter with a mark, a third longer. What
/// people see without marks has no message; what is cut has no room for other languages.
std::vector<PoFile::Message> pseudoMessages(const PoFile& messages);

}  // namespace palpa::language
