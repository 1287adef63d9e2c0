#pragma once

#include <memory>

namespace palpa {

/// What to do with a thread that hangs in a foreign library, at the end of whoever started it: a
/// thread cannot be ended from outside, and nobody may wait for it. Keeps `all` that the hanging
/// step uses until the program ends, and the code that the step runs in: from now on no library is
/// unloaded, and the program ends without asking them, since one of them may wait for its hanging
/// thread. What was registered with std::atexit after the first call still runs, and files of the
/// C library are flushed. Any thread, but not two at the same time.
void leaveBehind(std::shared_ptr<void> all);

}  // namespace palpa
