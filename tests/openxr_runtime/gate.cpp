#include "tests/openxr_runtime/gate.h"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "tests/openxr_runtime/plan.h"

namespace palpa::test_xr {
namespace {

constexpr int kDescriptors = 1024;  // more than a test's process has

/// A process that answers each byte with a byte, as a runtime's service does.
struct Service {
  pid_t process = 0;
  int question[2] = {-1, -1}, answer[2] = {-1, -1};

  [[noreturn]] void serve() const {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (int d = 0; d < kDescriptors; ++d)
      if (d != question[0] && d != answer[1]) close(d);
    for (char byte = 0; read(question[0], &byte, 1) == 1 && write(answer[1], &byte, 1) == 1;) {
    }
    _exit(0);
  }

  void start(const std::string& file) {
    if (process || pipe(question) != 0 || pipe(answer) != 0) return;
    process = fork();
    if (process == 0) serve();
    close(question[0]);
    close(answer[1]);
    std::ofstream(file) << process << '\n';
  }

  void ask() const {
    char byte = 1;
    if (write(question[1], &byte, 1) != 1) return;
    [[maybe_unused]] const auto answered = read(answer[0], &byte, 1);
  }

  void dismiss() {
    if (!process) return;
    close(question[1]);
    close(answer[0]);
    waitpid(process, nullptr, 0);
    process = 0;
  }
};
Service service;

bool isNamed(const std::string& file, const std::string& function) {
  std::ifstream in(file);
  for (std::string name; in >> name;)
    if (name == function) return true;
  return false;
}

/// As runtimes do that wait for their own threads when the program ends.
struct AtTheEnd {
  ~AtTheEnd() { pass("exit"); }
} at_the_end;

}  // namespace

void pass(const std::string& function) {
  const char* plan_text = std::getenv("PALPA_TEST_XR");
  if (!plan_text || (!std::strstr(plan_text, "hang=") && !std::strstr(plan_text, "service=")))
    return;
  const Plan plan = planFromEnvironment();
  if (!plan.service.empty()) {
    service.start(plan.service);
    service.ask();
  }
  if (plan.hang.empty() || !isNamed(plan.hang, function)) return;
  std::ofstream(plan.hang + ".reached") << function << '\n';
  while (isNamed(plan.hang, function)) usleep(1000);
}

void dismissService() { service.dismiss(); }

}  // namespace palpa::test_xr
