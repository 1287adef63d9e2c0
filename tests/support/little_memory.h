#pragma once

#include <sys/resource.h>

#include <fstream>

#include "counts.h"

namespace palpa::test {

/// While it lives the process gets no more than so many bytes beyond what it has: what asks for
/// more is refused. Not under a sanitizer, which needs terabytes of addresses.
class LittleMemory {
 public:
  explicit LittleMemory(rlim_t bytes) {
    if (kSanitized) return;
    getrlimit(RLIMIT_AS, &before_);
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit little = before_;
    little.rlim_cur = pages * 4096 + bytes;
    limited_ = pages > 0 && setrlimit(RLIMIT_AS, &little) == 0;
  }
  ~LittleMemory() {
    if (limited_) setrlimit(RLIMIT_AS, &before_);
  }
  LittleMemory(const LittleMemory&) = delete;
  LittleMemory& operator=(const LittleMemory&) = delete;

 private:
  rlimit before_{};
  bool limited_ = false;
};

}  // namespace palpa::test
