#pragma once

namespace palpa::ar {

/// From now on no library of this process is unloaded, not even at its end: a thread that never
/// comes back runs in one of them, and would run on where no code is any more.
void keepLibrariesLoaded();

}  // namespace palpa::ar
