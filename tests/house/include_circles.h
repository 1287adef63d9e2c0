#pragma once

#include <string>
#include <vector>

#include "source_tree.h"

namespace palpa::house {

/// Folders of the product that include each other, directly or through others, a line each:
/// "a -> b -> a: a/x.h includes b/y.h, ...". A folder is a node of its own, apart from its rooms.
std::vector<std::string> folderCircles(const std::vector<SourceFile>& tree);

/// The same for headers: no header needs itself.
std::vector<std::string> headerCircles(const std::vector<SourceFile>& tree);

}  // namespace palpa::house
