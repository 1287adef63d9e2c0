#pragma once

#include <string>
#include <vector>

namespace palpa::console {

/// What a console starts, played: `facts` tells of the process itself; `doctor` finds nothing;
/// `train` is a session with a log of its own, until it is told to leave, at most a minute;
/// `report` writes a page; `wait` waits for Ctrl-C; all else complains. Returns the exit code.
int playCommand(const std::vector<std::string>& arguments);

}  // namespace palpa::console
