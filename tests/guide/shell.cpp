#include "shell.h"

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

namespace palpa::guide {
namespace {
int exitCodeOf(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}
}  // namespace

std::string outputOf(const std::string& command) {
  FILE* pipe = ::popen(command.c_str(), "r");
  if (!pipe) throw std::runtime_error("no shell");
  std::string said;
  std::array<char, 4096> some;
  for (std::size_t n; (n = std::fread(some.data(), 1, some.size(), pipe)) > 0;)
    said.append(some.data(), n);
  if (const int code = exitCodeOf(::pclose(pipe)); code != 0)
    throw std::runtime_error(command + " exits with " + std::to_string(code) + ":\n" + said);
  return said;
}

int run(const std::string& command) {
  std::fflush(stdout);
  return exitCodeOf(std::system(command.c_str()));
}

}  // namespace palpa::guide
