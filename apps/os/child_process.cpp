#include "apps/os/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <sstream>

#include "anatomy/base/error.h"

extern char** environ;

namespace palpa::os {
namespace {

constexpr int kNice = 10, kFirstOfOurs = 3;
constexpr std::streamoff kTail = 16 << 10;

/// 0: there is no such process, or it has ended and waits to be put away.
std::uint64_t beganAt(int pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::size_t name_end = text.rfind(')');
  if (name_end == std::string::npos) return 0;
  std::istringstream fields(text.substr(name_end + 1));
  std::string state, skipped;
  fields >> state;
  if (state == "Z" || state == "X") return 0;
  for (int field = 4; field < 22; ++field) fields >> skipped;
  std::uint64_t began = 0;
  fields >> began;
  return began;
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

}  // namespace

ProcessId start(const std::vector<std::string>& arguments, const std::filesystem::path& log,
                bool gives_way) {
  Spawning how;
  posix_spawn_file_actions_addopen(&how.files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&how.files, STDOUT_FILENO, log.c_str(),
                                   O_WRONLY | O_CREAT | O_APPEND, 0600);
  posix_spawn_file_actions_adddup2(&how.files, STDOUT_FILENO, STDERR_FILENO);
  posix_spawn_file_actions_addclosefrom_np(&how.files, kFirstOfOurs);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&how.attributes, &none);
  posix_spawnattr_setflags(&how.attributes, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK);
  std::vector<std::string> words{"palpa"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t pid = 0;
  if (const int error =
          posix_spawn(&pid, "/proc/self/exe", &how.files, &how.attributes, argv.data(), environ))
    throw Error(std::string("cannot be started (") + std::strerror(error) + ")",
                "palpa " + arguments.front(), "Look for memory and disk space");
  if (gives_way) ::setpriority(PRIO_PROCESS, static_cast<id_t>(pid), kNice);
  return {pid, beganAt(pid)};
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

std::vector<std::string> lastLines(const std::filesystem::path& log, std::size_t most) {
  std::ifstream file(log, std::ios::binary | std::ios::ate);
  if (!file) return {};
  const std::streamoff size = file.tellg();
  file.seekg(std::max<std::streamoff>(0, size - kTail));
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (const std::size_t anew = line.rfind('\r'); anew != std::string::npos)
      line.erase(0, anew + 1);
    if (!line.empty()) lines.push_back(line);
  }
  if (lines.size() > most)
    lines.erase(lines.begin(), lines.end() - static_cast<std::ptrdiff_t>(most));
  return lines;
}

std::string complaintIn(const std::filesystem::path& log) {
  const std::vector<std::string> lines = lastLines(log, 50);
  const auto found = std::find_if(lines.rbegin(), lines.rend(), [](const std::string& line) {
    return line.rfind("palpa: ", 0) == 0;
  });
  return found == lines.rend() ? "" : found->substr(7);
}

}  // namespace palpa::os
