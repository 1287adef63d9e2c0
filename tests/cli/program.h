#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

namespace palpa::cli_test {

/// What the program left behind.
struct Outcome {
  int exit_code = -1;  ///< 128 + signal when it was killed
  std::string out, err;

  int errLines() const;  ///< lines on standard error
};

/// Runs the built `palpa` with these arguments, in `folder`, without a display; waits for its end.
Outcome palpa(const std::vector<std::string>& arguments, const std::filesystem::path& folder);

/// What a command printed, one JSON object a line.
std::vector<nlohmann::json> jsonLines(const Outcome& outcome);

/// Names and values.
using Environment = std::vector<std::pair<std::string, std::string>>;

/// A run of `palpa` that goes on while the test does; killed at the end of its life, if it still
/// runs. Its standard error goes to the file `err`. `more`: in its environment, besides this
/// process's.
class Running {
 public:
  Running(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
          const std::filesystem::path& err = "/dev/null", const Environment& more = {});
  ~Running();
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  bool ended();  ///< by itself
  void kill();   ///< with SIGKILL, and waits until it is gone
  /// With this signal (default: as Ctrl-C does), and waits for its end; its exit code, 128 + signal
  /// when that killed it
  int interrupt(int signal = 2);
  void send(int signal) const;            ///< and goes on
  int exitCode() const { return code_; }  ///< once it has ended; 128 + signal when that killed it

 private:
  int child_ = -1, code_ = -1;
};

/// A folder of its own for one test, empty at the start, gone at the end.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  /// Writes a file into it and says its path.
  std::string file(const std::string& name, const std::string& bytes) const;
  /// Every file below, relative, sorted.
  std::vector<std::string> files() const;

 private:
  std::filesystem::path path_;
};

inline bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

std::string contentOf(const std::filesystem::path& file);

/// The lens of the shipped virtual bench's camera, as OpenCV writes one down.
std::string benchLens();

/// A trial's seed with which the simulated expert is done soon, in 13 s of session time; so he is
/// with the one before.
inline constexpr const char* kShortTrial = "41";

/// The file of a shipped station ("virtual_bench.json") whose camera takes one picture a second:
/// to draw and to read them is most of a session's computing, and changes no score.
std::string quickStation(const std::string& shipped);

/// The arguments of a quick session of `words`, a command and its options: virtual time, no views,
/// no progress, and the board tracked by a model instead of in pictures, where they name no station
/// and keep no pictures. (`train` may be of any task, and is given no station.)
std::vector<std::string> quickly(std::vector<std::string> words);

/// The same of a simulated expert with a needle.
std::vector<std::string> session(const std::vector<std::string>& more);

/// The file of a shipped task ("palpation_breast") with these changes (RFC 7386).
std::string taskWith(const std::string& shipped, const nlohmann::json& changes, const Folder& here);

}  // namespace palpa::cli_test
