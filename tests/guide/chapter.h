#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "commands.h"
#include "markdown.h"

namespace palpa::guide {

/// Every stated count: what is marked "sh slow" is run as well.
bool everything();

/// A script of the page's commands, and of the files that its blocks hold (```json NAME), in their
/// order.
std::string scriptOf(const Page& page, const std::filesystem::path& work);

/// The commands of the blocks marked sh.
std::vector<Command> commandsOf(const Page& page);

/// Lines of commands that were not run, for want of Chromium, or since they are slow.
std::set<int> skippedIn(const Page& page, const std::filesystem::path& work);

}  // namespace palpa::guide
