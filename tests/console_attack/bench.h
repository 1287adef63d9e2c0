#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "raw_http.h"
#include "tests/support/short_folder.h"

namespace palpa::console_attack {

namespace fs = std::filesystem;

/// Until `seen`, for at most two minutes: only a fault lasts longer.
bool inTime(const std::function<bool()>& seen);
std::string contentOf(const fs::path& file);
/// Of a process, MiB; 0: it is gone.
double residentMiB(pid_t pid);

/// Starts the built program in `folder`, without a display; its words go to `out`.
pid_t startProgram(const std::vector<std::string>& arguments, const fs::path& folder,
                   const fs::path& out);
/// Its exit code, 128 + signal when that ended it.
int waitFor(pid_t pid);

using test::ShortFolder;

/// A console of the built program, in a folder of its own.
class Console {
 public:
  Console(const fs::path& folder, std::vector<std::string> more = {});
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  void begin();
  void kill();      ///< SIGKILL
  int interrupt();  ///< as Ctrl-C does; its exit code
  pid_t pid() const { return pid_; }
  int port() const { return port_; }
  std::string host() const { return "127.0.0.1:" + std::to_string(port_); }
  fs::path home() const { return folder_ / "home"; }
  std::string refused() const { return contentOf(home() / "refused.log"); }
  std::string words() const { return contentOf(folder_ / "console.out"); }

  std::string cookie;  ///< sent with what pages ask
  std::string pageKey();
  static std::string newNumber();  ///< for a write
  Headers readHeaders() const;     ///< as a page asks
  Headers writeHeaders(const std::string& body);
  /// As a page asks; anew where the console was full.
  Answer get(const std::string& path);
  Answer post(const std::string& path, const nlohmann::json& body);
  /// Exactly these bytes.
  Answer raw(const std::string& bytes, const std::string& from = "");
  /// As an EventSource does: anew where there was no place. Events after `last` (empty: all), until
  /// `enough` says so or the stream ends.
  std::vector<Event> events(const std::string& session, const std::string& last,
                            const std::function<bool(const std::vector<Event>&)>& enough);

 private:
  const fs::path folder_;
  const std::vector<std::string> more_;
  std::string key_;
  pid_t pid_ = -1;
  int port_ = 0;
};

}  // namespace palpa::console_attack
