#include "program.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace palpa::cli_test {
namespace {

namespace fs = std::filesystem;

void redirect(const fs::path& file, int stream) {
  const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (fd < 0 || ::dup2(fd, stream) < 0) ::_exit(126);
  ::close(fd);
}

/// From whoever runs the tests: their records and what waits to be sent. A test that means records
/// by the environment names them in PALPA_TEST_RECORDS; one that means the program's place for
/// temporary files, and not its own, in PALPA_TEST_TMPDIR.
void keepApart(const fs::path& folder) {
  ::setenv("XDG_STATE_HOME", (folder / "state").c_str(), 0);
  if (const char* records = std::getenv("PALPA_TEST_RECORDS"))
    ::setenv("PALPA_RECORDS", records, 1);
  else
    ::unsetenv("PALPA_RECORDS");
  if (const char* temporary = std::getenv("PALPA_TEST_TMPDIR")) ::setenv("TMPDIR", temporary, 1);
}

/// A test that means the program's files to end at some size names it in PALPA_TEST_FILE_LIMIT.
void limitFiles() {
  const char* bytes = std::getenv("PALPA_TEST_FILE_LIMIT");
  if (!bytes) return;
  const rlim_t most = std::strtoul(bytes, nullptr, 10);
  const rlimit limit{most, most};
  if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) ::_exit(126);
}

[[noreturn]] void become(std::vector<std::string> arguments, const fs::path& folder,
                         const fs::path& out, const fs::path& err, const Environment& more,
                         int fill) {
  // Fresh memory holds another byte in every run: what is read before it is written then differs.
  ::setenv("MALLOC_PERTURB_", std::to_string(fill).c_str(), 1);
  for (const int asks : {SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2})
    ::signal(asks, SIG_DFL);  // whatever runs the tests ignores
  redirect("/dev/null", STDIN_FILENO);
  redirect(out, STDOUT_FILENO);
  redirect(err, STDERR_FILENO);
  if (::chdir(folder.c_str()) != 0) ::_exit(126);
  ::unsetenv("DISPLAY");
  for (const auto& [name, value] : more) ::setenv(name.c_str(), value.c_str(), 1);
  keepApart(folder);
  limitFiles();
  arguments.insert(arguments.begin(), PALPA_PROGRAM);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  ::execv(PALPA_PROGRAM, argv.data());
  ::_exit(127);
}

int codeOf(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status); }

fs::path newFolder() {
  static std::atomic<int> count{0};
  return fs::temp_directory_path() /
         ("palpa-cli-" + std::to_string(::getpid()) + "-" + std::to_string(++count));
}

/// Starts the program; every run is filled with another byte.
pid_t start(const std::vector<std::string>& arguments, const fs::path& folder, const fs::path& out,
            const fs::path& err, const Environment& more = {}) {
  static std::atomic<int> runs{0};
  const int fill = 1 + 37 * runs++ % 255;
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) become(arguments, folder, out, err, more, fill);
  return child;
}

}  // namespace

int Outcome::errLines() const {
  const auto ends = std::count(err.begin(), err.end(), '\n');
  return static_cast<int>(ends) + (!err.empty() && err.back() != '\n');
}

std::vector<nlohmann::json> jsonLines(const Outcome& outcome) {
  std::vector<nlohmann::json> lines;
  std::istringstream text(outcome.out);
  for (std::string line; std::getline(text, line);) lines.push_back(nlohmann::json::parse(line));
  return lines;
}

Running::Running(const std::vector<std::string>& arguments, const fs::path& folder,
                 const fs::path& err, const Environment& more)
    : child_(start(arguments, folder, "/dev/null", err, more)) {}

Running::~Running() { kill(); }

bool Running::ended() {
  int status = 0;
  if (child_ > 0 && ::waitpid(child_, &status, WNOHANG) == child_) {
    child_ = -1;
    code_ = codeOf(status);
  }
  return child_ < 0;
}

void Running::send(int signal) const {
  if (child_ > 0) ::kill(child_, signal);
}

int Running::interrupt(int signal) {
  static_assert(SIGINT == 2);
  if (child_ < 0) return -1;
  ::kill(child_, signal);
  int status = 0;
  while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
  return code_ = codeOf(status);
}

void Running::kill() {
  if (child_ < 0) return;
  ::kill(child_, SIGKILL);
  while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
}

Outcome palpa(const std::vector<std::string>& arguments, const fs::path& folder) {
  const Folder streams;
  const fs::path out = streams / "out", err = streams / "err";
  const pid_t child = start(arguments, folder, out, err);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return {codeOf(status), contentOf(out), contentOf(err)};
}

Folder::Folder() : path_(newFolder()) { fs::create_directories(path_); }

Folder::~Folder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string Folder::file(const std::string& name, const std::string& bytes) const {
  const fs::path file = path_ / name;
  std::ofstream(file, std::ios::binary) << bytes;
  return file.string();
}

std::vector<std::string> Folder::files() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(path_))
    if (!entry.is_directory()) names.push_back(fs::relative(entry.path(), path_).generic_string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string contentOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::string benchLens() {
  const auto camera = nlohmann::json::parse(
      contentOf(fs::path(PALPA_SOURCE_DIR) / "assets/stations/virtual_bench.json"))["camera"];
  const auto list = [](const nlohmann::json& of, const std::vector<const char*>& names) {
    std::string all;
    for (const char* name : names)
      all += (all.empty() ? "" : ", ") + (of.contains(name) ? of[name].dump() : std::string(name));
    return all;
  };
  return "%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\ncamera_matrix: !!opencv-matrix\n"
         "  rows: 3\n  cols: 3\n  dt: d\n  data: [" +
         list(camera, {"fx_px", "0.", "cx_px", "0.", "fy_px", "cy_px", "0.", "0.", "1."}) +
         "]\ndistortion_coefficients: !!opencv-matrix\n  rows: 5\n  cols: 1\n  dt: d\n  data: [" +
         list(camera["distortion"], {"k1", "k2", "p1", "p2", "k3"}) + "]\n";
}

std::string quickStation(const std::string& shipped) {
  static const Folder here;
  if (!fs::exists(here / shipped)) {
    nlohmann::json station =
        nlohmann::json::parse(contentOf(fs::path(PALPA_SOURCE_DIR) / "assets/stations" / shipped));
    station["camera"]["rate_Hz"] = 1;
    here.file(shipped, station.dump());
  }
  return (here / shipped).string();
}

std::vector<std::string> quickly(std::vector<std::string> words) {
  const std::string command = words.front();
  const auto has = [&](const char* option) {
    return std::find(words.begin(), words.end(), option) != words.end();
  };
  std::vector<std::string> more{"--fast", "--no-views", "--quiet"};
  if (command != "train" && !has("--station")) {
    const std::string station = command == "subclavian" ? "virtual_bench.json"
                                : command == "search"   ? "search_bench.json"
                                                        : "palpation_bench.json";
    more.insert(more.end(), {"--station", quickStation(station)});
    if (!has("--camera") && !has("--record-video"))
      more.insert(more.end(), {"--tracking", "model"});
  }
  words.insert(words.begin() + 1, more.begin(), more.end());
  return words;
}

std::string taskWith(const std::string& shipped, const nlohmann::json& changes,
                     const Folder& here) {
  const fs::path tasks = fs::path(PALPA_SOURCE_DIR) / "assets/tasks";
  nlohmann::json task = nlohmann::json::parse(contentOf(tasks / (shipped + ".json")));
  task["lumps"] = (tasks / task["lumps"].get<std::string>()).lexically_normal().string();
  task.merge_patch(changes);
  return here.file("changed_" + shipped + ".json", task.dump());
}

std::vector<std::string> session(const std::vector<std::string>& more) {
  std::vector<std::string> all{"subclavian", "--operator", "expert"};
  all.insert(all.end(), more.begin(), more.end());
  return quickly(all);
}

}  // namespace palpa::cli_test
