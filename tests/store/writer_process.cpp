#include "tests/store/writer_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>
#include <utility>

namespace palpa::test {

WriterProcess::WriterProcess(const std::vector<std::string>& arguments) {
  ::signal(SIGPIPE, SIG_IGN);  // of one that was killed
  int in[2], out[2];
  if (::pipe2(in, O_CLOEXEC) != 0 || ::pipe2(out, O_CLOEXEC) != 0)
    throw std::runtime_error("no pipe");
  std::vector<char*> words{const_cast<char*>(PALPA_WRITER)};
  for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  process_ = ::fork();
  if (process_ == 0) {
    ::dup2(in[0], STDIN_FILENO);
    ::dup2(out[1], STDOUT_FILENO);
    ::execv(words[0], words.data());
    ::_exit(127);
  }
  ::close(in[0]);
  ::close(out[1]);
  in_ = in[1];
  out_ = out[0];
}

WriterProcess::WriterProcess(WriterProcess&& other) noexcept
    : process_(std::exchange(other.process_, -1)),
      in_(std::exchange(other.in_, -1)),
      out_(std::exchange(other.out_, -1)),
      arrived_(other.arrived_),
      code_(other.code_) {}

WriterProcess::~WriterProcess() {
  kill();
  if (in_ >= 0) ::close(in_);
  if (out_ >= 0) ::close(out_);
}

void WriterProcess::tell(const std::string& words) {
  (void)!::write(in_, words.data(), words.size());
}
void WriterProcess::allow(int trials) { tell(std::string(static_cast<std::size_t>(trials), 'g')); }
void WriterProcess::allowAll() { tell("f"); }

bool WriterProcess::waitFor(int arrived) {
  for (char word = 0; arrived_ < arrived; ++arrived_)
    if (::read(out_, &word, 1) != 1) return false;
  return true;
}

void WriterProcess::kill() {
  if (process_ <= 0) return;
  ::kill(process_, SIGKILL);
  wait();
}

int WriterProcess::wait() {
  if (process_ <= 0) return code_;
  int status = 0;
  ::waitpid(process_, &status, 0);
  process_ = -1;
  return code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace palpa::test
