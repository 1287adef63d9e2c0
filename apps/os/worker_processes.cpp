#include "apps/os/worker_processes.h"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <string_view>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"

namespace palpa::os {
namespace {

/// Each line on the way to the parent begins with what it is.
constexpr char kSaid = 's', kFailed = 'f', kWentThrough = 'w';
constexpr int kLook_ms = 100, kLooks = 100;  // for the end of a process

void sendLine(int line, char kind, const std::string& text) {
  std::string bytes = kind + text.substr(0, text.find('\n')) + '\n';
  for (std::string_view left = bytes; !left.empty();) {
    const ssize_t sent = ::write(line, left.data(), left.size());
    if (sent < 0 && errno != EINTR) return;  // nobody reads: the parent is gone
    if (sent > 0) left.remove_prefix(static_cast<std::size_t>(sent));
  }
}

[[noreturn]] void beWorker(int line, const std::function<void(const Report&)>& work) {
  try {
    work([line](const std::string& text) { sendLine(line, kSaid, text); });
    sendLine(line, kWentThrough, "");
  } catch (const Error& e) {
    sendLine(line, kFailed, e.what());
  } catch (const std::bad_alloc&) {
    sendLine(line, kFailed, "there is not enough memory for this");
  } catch (const std::filesystem::filesystem_error& e) {
    sendLine(line, kFailed,
             e.path1().string() + ": cannot be used (" + fileTrouble(e.code().value()).why + ")");
  } catch (const std::exception&) {
    sendLine(line, kFailed, "something failed that was not foreseen");
  }
  std::fflush(stdout);
  ::_exit(0);
}

std::string signalWords(int status) {
  if (!WIFSIGNALED(status)) return "its process ended by itself";
  const char* name = ::sigabbrev_np(WTERMSIG(status));
  return std::string("its process was ended by signal ") +
         (name ? name : std::to_string(WTERMSIG(status)));
}

int waitFor(int pid) {
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace

WorkerPool::WorkerPool(std::size_t most) : most_(std::max<std::size_t>(most, 1)) {}

WorkerPool::~WorkerPool() {
  askToEnd();
  for (Worker& worker : workers_) {
    for (int look = 0; look < kLooks && !worker.ended; ++look) {
      pollfd line{worker.line, POLLIN, 0};
      ::poll(&line, 1, kLook_ms);
      readLines(worker);
    }
    if (!worker.ended) {  // it hangs
      ::kill(worker.pid, SIGKILL);
      waitFor(worker.pid);
    }
    ::close(worker.line);
  }
}

bool WorkerPool::tryStart(std::size_t item, const std::function<void(const Report&)>& work) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return false;
  std::fflush(stdout);  // or both would write what waits
  const pid_t parent = ::getpid(), child = ::fork();
  if (child == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);  // nobody works on for a parent that was killed
    if (::getppid() != parent) ::_exit(1);
    ::close(ends[0]);
    beWorker(ends[1], work);
  }
  ::close(ends[1]);
  if (child < 0) {
    ::close(ends[0]);
    return false;
  }
  ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
  workers_.push_back({.item = item, .pid = child, .line = ends[0]});
  return true;
}

void WorkerPool::start(std::size_t item, const std::function<void(const Report&)>& work) {
  while (!tryStart(item, work)) {
    const bool hope = std::any_of(workers_.begin(), workers_.end(),
                                  [](const Worker& worker) { return !worker.ended; });
    if (!hope)
      throw Error("the system gives no further process", "palpa",
                  "End other programs, or raise the limit (ulimit -u)");
    for (Worker& worker : workers_)
      if (!worker.ended) {
        pollfd there{worker.line, POLLIN, 0};
        ::poll(&there, 1, kLook_ms);
        readLines(worker);
      }
  }
}

void WorkerPool::readLines(Worker& worker) {
  char bytes[4096];
  ssize_t count = 0;
  while ((count = ::read(worker.line, bytes, sizeof bytes)) > 0)
    worker.unread.append(bytes, static_cast<std::size_t>(count));
  const bool at_end = count == 0;
  for (std::size_t end; (end = worker.unread.find('\n')) != std::string::npos;) {
    const char kind = worker.unread.front();
    const std::string text = worker.unread.substr(1, end - 1);
    worker.unread.erase(0, end + 1);
    if (kind == kSaid) worker.lines.push_back(text);
    if (kind == kFailed) worker.failure = text;
    if (kind == kWentThrough) worker.went_through = true;
  }
  if (!at_end || worker.ended) return;
  worker.ended = true;
  const int status = waitFor(worker.pid);
  if (!worker.went_through && worker.failure.empty()) worker.failure = signalWords(status);
}

std::vector<WorkerNews> WorkerPool::takeNews() {
  std::vector<WorkerNews> news;
  for (auto worker = workers_.begin(); worker != workers_.end();) {
    if (!worker->lines.empty() || worker->ended)
      news.push_back({worker->item, std::move(worker->lines), worker->ended, worker->failure});
    worker->lines.clear();
    if (worker->ended) ::close(worker->line);
    worker = worker->ended ? workers_.erase(worker) : std::next(worker);
  }
  return news;
}

std::vector<WorkerNews> WorkerPool::await(std::int64_t at_most_ns) {
  std::vector<WorkerNews> news = takeNews();
  if (!news.empty()) return news;
  std::vector<pollfd> lines;
  for (const Worker& worker : workers_) lines.push_back({worker.line, POLLIN, 0});
  ::poll(lines.data(), lines.size(), static_cast<int>(at_most_ns / 1'000'000));
  for (Worker& worker : workers_) readLines(worker);
  return takeNews();
}

void WorkerPool::askToEnd() {
  for (const Worker& worker : workers_)
    if (!worker.ended) ::kill(worker.pid, SIGTERM);
}

void sendOutputTo(const std::filesystem::path& file) {
  const int opened =
      ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (opened < 0) failFile("cannot be written", file, errno);
  std::fflush(stdout);
  ::dup2(opened, STDOUT_FILENO);
  ::dup2(opened, STDERR_FILENO);
  ::close(opened);
}

int processorsForUs() {
  cpu_set_t ours;
  CPU_ZERO(&ours);
  if (::sched_getaffinity(0, sizeof ours, &ours) != 0) return 1;
  return std::max(CPU_COUNT(&ours), 1);
}

}  // namespace palpa::os
