#include "apps/os/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <sstream>
#include <utility>

#include "anatomy/base/whole_file.h"
#include "apps/os/real_time.h"

extern char** environ;

namespace palpa::os {
namespace {

constexpr int kNice = 5, kFirstOfOurs = 3;

struct ProcessState {
  char letter = 'X';
  int threads = 0;
  std::uint64_t began = 0;
};
ProcessState stateOf(int pid) {
  const std::string text = readWhole("/proc/" + std::to_string(pid) + "/stat").value_or("");
  const std::size_t name_end = text.rfind(')');
  if (name_end == std::string::npos) return {};
  std::istringstream fields(text.substr(name_end + 1));
  ProcessState state;
  std::string skipped;
  fields >> state.letter;
  for (int field = 4; field < 20; ++field) fields >> skipped;
  fields >> state.threads >> skipped >> state.began;
  return state;
}

/// 0: there is no such process, or it has ended and waits to be put away. One of which the first
/// thread alone has ended holds its files, locks and sockets still.
std::uint64_t beganAt(int pid) {
  const ProcessState state = stateOf(pid);
  const bool ended = state.letter == 'X' || (state.letter == 'Z' && state.threads <= 1);
  return ended ? 0 : state.began;
}

struct Spawning {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  Spawning() {
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
  }
  ~Spawning() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
};

/// As C takes a list of words, while `words` stay.
std::vector<char*> pointersTo(std::vector<std::string>& words) {
  std::vector<char*> all;
  for (std::string& word : words) all.push_back(word.data());
  all.push_back(nullptr);
  return all;
}

/// The first of the words is the name under which it runs. Its descriptor 0 is in `how`; the others
/// go to `log`.
ProcessId spawn(Spawning& how, const char* program, std::vector<std::string> words,
                const std::filesystem::path& log) {
  posix_spawn_file_actions_addopen(&how.files, STDOUT_FILENO, log.c_str(),
                                   O_WRONLY | O_CREAT | O_APPEND | O_NOFOLLOW, 0600);
  posix_spawn_file_actions_adddup2(&how.files, STDOUT_FILENO, STDERR_FILENO);
  posix_spawn_file_actions_addclosefrom_np(&how.files, kFirstOfOurs);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&how.attributes, &none);
  posix_spawnattr_setflags(&how.attributes, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK);
  pid_t pid = 0;
  if (const int error = posix_spawn(&pid, program, &how.files, &how.attributes,
                                    pointersTo(words).data(), environ))
    failFile("cannot be started", words[0] + (words.size() > 1 ? " " + words[1] : ""), error);
  return {pid, beganAt(pid)};
}

std::vector<std::string> named(const std::string& name, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{name};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

ProcessId spawnAnew(Spawning& how, const std::vector<std::string>& arguments,
                    const std::filesystem::path& log) {
  return spawn(how, "/proc/self/exe", named("palpa", arguments), log);
}

}  // namespace

ProcessId start(const std::vector<std::string>& arguments, const std::filesystem::path& log,
                bool gives_way) {
  Spawning how;
  posix_spawn_file_actions_addopen(&how.files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  const ProcessId process = spawnAnew(how, arguments, log);
  if (gives_way) ::setpriority(PRIO_PROCESS, static_cast<id_t>(process.pid), kNice);
  return process;
}

ProcessId startInstalled(const std::filesystem::path& program,
                         const std::vector<std::string>& arguments,
                         const std::filesystem::path& log) {
  Spawning how;
  posix_spawn_file_actions_addopen(&how.files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  return spawn(how, program.c_str(), named(program.filename().string(), arguments), log);
}

ProcessStarter::ProcessStarter() : thread_(startThread([this] { run(); })) {}

ProcessStarter::~ProcessStarter() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

ProcessId ProcessStarter::start(const std::vector<std::string>& arguments,
                                const std::filesystem::path& log) {
  std::packaged_task<ProcessId()> task([&] { return os::start(arguments, log, false); });
  std::future<ProcessId> started = task.get_future();
  {
    const std::lock_guard lock(mutex_);
    asked_.push(std::move(task));
  }
  changed_.notify_all();
  return started.get();
}

void ProcessStarter::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] { return ending_ || !asked_.empty(); });
    if (asked_.empty()) return;
    std::packaged_task<ProcessId()> task = std::move(asked_.front());
    asked_.pop();
    lock.unlock();
    task();
    lock.lock();
  }
}

Companion startWithLine(const std::vector<std::string>& arguments) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends) != 0)
    failFile("cannot be started", "palpa " + arguments.front(), errno);
  Spawning how;
  posix_spawn_file_actions_adddup2(&how.files, ends[1], STDIN_FILENO);
  try {
    const ProcessId process = spawnAnew(how, arguments, "/dev/null");
    ::close(ends[1]);
    return {process, ends[0]};
  } catch (...) {
    ::close(ends[0]);
    ::close(ends[1]);
    throw;
  }
}

Spent runToEnd(const std::vector<std::string>& arguments, const std::filesystem::path& log) {
  const ProcessId process = start(arguments, log, false);
  int status = 0;
  rusage used{};
  while (::wait4(process.pid, &status, 0, &used) < 0)
    if (errno != EINTR) failFile("cannot be waited for", "palpa " + arguments.front(), errno);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1,
          seconds(used.ru_utime) + seconds(used.ru_stime),
          1.024e-3 * static_cast<double>(used.ru_maxrss)};
}

bool isStopped(const ProcessId& process) {
  const ProcessState state = stateOf(process.pid);
  return state.letter == 'T' && state.began == process.began;
}

void endAtOnce(const ProcessId& process) {
  if (runs(process)) ::kill(process.pid, SIGKILL);
}

bool runs(const ProcessId& process) {
  if (process.pid <= 0) return false;
  const std::uint64_t began = beganAt(process.pid);
  if (began != 0 && began == process.began) return true;
  ::waitpid(process.pid, nullptr, WNOHANG);  // put away, where it was ours
  return false;
}

void askToEnd(const ProcessId& process) {
  if (runs(process)) ::kill(process.pid, SIGINT);
}

void becomeAnew(const std::vector<std::string>& arguments) {
  std::vector<std::string> words = named("palpa", arguments);
  ::signal(SIGPIPE, SIG_DFL);  // ignored, it would stay so
  ::execv("/proc/self/exe", pointersTo(words).data());
}

bool startProgram(const std::string& name, const std::vector<std::string>& arguments) {
  std::vector<std::string> words = named(name, arguments);
  pid_t pid = 0;
  return posix_spawnp(&pid, name.c_str(), nullptr, nullptr, pointersTo(words).data(), environ) == 0;
}

int processNumber() { return ::getpid(); }

ProcessId thisProcess() { return {::getpid(), beganAt(::getpid())}; }

std::string programName() {
  std::error_code none;
  return std::filesystem::read_symlink("/proc/self/exe", none).filename().string();
}

}  // namespace palpa::os
