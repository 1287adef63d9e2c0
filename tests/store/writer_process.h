#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace palpa::test {

/// A station as a process of its own (tests/store/writer).
class WriterProcess {
 public:
  explicit WriterProcess(const std::vector<std::string>& arguments);
  ~WriterProcess();  ///< killed, if it still runs
  WriterProcess(WriterProcess&& other) noexcept;
  WriterProcess(const WriterProcess&) = delete;

  void allow(int trials);  ///< so many more
  void allowAll();
  bool waitFor(int arrived);  ///< until it says that so many have arrived; false: it ended before
  int arrived() const { return arrived_; }
  void kill();  ///< SIGKILL, and waits until it is gone
  int wait();   ///< for its end; its exit code, 128 + signal when it was killed

 private:
  void tell(const std::string& words);
  pid_t process_ = -1;
  int in_ = -1, out_ = -1, arrived_ = 0, code_ = -1;
};

}  // namespace palpa::test
