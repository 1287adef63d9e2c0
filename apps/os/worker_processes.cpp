#include "apps/os/worker_processes.h"

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

#include "anatomy/base/error.h"

namespace palpa::os {

SharedPages::SharedPages(std::size_t size, const std::string& advice)
    : begin_(::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)),
      size_(size) {
  if (begin_ == MAP_FAILED) throw Error("cannot be shared among processes", "memory", advice);
}

SharedPages::~SharedPages() { ::munmap(begin_, size_); }

bool forkWorker(const std::function<void()>& work) {
  std::fflush(stdout);  // or both would write what waits
  const pid_t child = ::fork();
  if (child != 0) return child > 0;
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);  // nobody works on for a parent that was killed
  work();
  std::fflush(stdout);
  ::_exit(0);
}

std::optional<EndedWorker> takeEnded() {
  int status = 0;
  if (::waitpid(-1, &status, WNOHANG) <= 0) return std::nullopt;
  return EndedWorker{WIFEXITED(status) && WEXITSTATUS(status) == 0};
}

}  // namespace palpa::os
