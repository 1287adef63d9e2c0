#include "bench.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "apps/runtime/clock.h"

namespace palpa::console_attack {
namespace {

using namespace std::chrono_literals;

[[noreturn]] void become(std::vector<std::string> arguments, const fs::path& folder,
                         const fs::path& out) {
  const int words = ::open(out.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600),
            nothing = ::open("/dev/null", O_RDONLY);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(words, STDOUT_FILENO);
  ::dup2(words, STDERR_FILENO);
  if (::chdir(folder.c_str()) != 0) ::_exit(126);
  ::unsetenv("DISPLAY");
  ::unsetenv("PALPA_RECORDS");
  ::setenv("XDG_RUNTIME_DIR", (folder / "run").c_str(), 1);
  ::setenv("XDG_STATE_HOME", (folder / "state").c_str(), 1);
  arguments.insert(arguments.begin(), "palpa");
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  ::execv(PALPA_PROGRAM, argv.data());
  ::_exit(127);
}

}  // namespace

bool inTime(const std::function<bool()>& seen) { return runtime::comesTrue(120s, seen); }

std::string contentOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

double residentMiB(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/status");
  for (std::string word; file >> word;)
    if (word == "VmRSS:") {
      double kib = 0;
      file >> kib;
      return kib / 1024;
    }
  return 0;
}

pid_t startProgram(const std::vector<std::string>& arguments, const fs::path& folder,
                   const fs::path& out) {
  fs::create_directories(folder / "run");
  fs::permissions(folder / "run", fs::perms::owner_all);
  const pid_t pid = ::fork();
  if (pid < 0) throw std::runtime_error("fork failed");
  if (pid == 0) become(arguments, folder, out);
  return pid;
}

int waitFor(pid_t pid) {
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

Console::Console(const fs::path& folder, std::vector<std::string> more)
    : folder_(folder), more_(std::move(more)) {
  begin();
}

Console::~Console() { kill(); }

void Console::begin() {
  std::error_code none;
  fs::remove(folder_ / "console.out", none);
  key_.clear();
  std::vector<std::string> arguments{"console",   "--no-open",
                                     "--home",    home().string(),
                                     "--records", (folder_ / "records.sqlite").string()};
  arguments.insert(arguments.end(), more_.begin(), more_.end());
  pid_ = startProgram(arguments, folder_, folder_ / "console.out");
  const std::string before = "The console: http://127.0.0.1:";
  if (!inTime([&] {
        return words().find(before) != std::string::npos &&
               words().find("Ctrl-C") != std::string::npos;
      }))
    throw std::runtime_error("no console: " + words());
  port_ = std::atoi(words().c_str() + words().find(before) + before.size());
}

void Console::kill() {
  if (pid_ < 0) return;
  ::kill(pid_, SIGKILL);
  waitFor(pid_);
  pid_ = -1;
}

int Console::interrupt() {
  ::kill(pid_, SIGINT);
  const int code = waitFor(pid_);
  pid_ = -1;
  return code;
}

std::string Console::newNumber() {
  static std::atomic<unsigned> count{0};
  char text[33];
  std::snprintf(text, sizeof text, "%016x%016x", static_cast<unsigned>(::getpid()), ++count);
  return text;
}

std::string Console::pageKey() {
  if (key_.empty()) key_ = get("/api/me").json().value("page_key", "");
  return key_;
}

Headers Console::readHeaders() const {
  Headers all{{"Host", host()}, {"Sec-Fetch-Site", "same-origin"}, {"Connection", "close"}};
  if (!cookie.empty()) all.emplace_back("Cookie", cookie);
  return all;
}

Headers Console::writeHeaders(const std::string& body) {
  const std::string key = pageKey();
  Headers all = readHeaders();
  for (const auto& [name, value] : Headers{{"Origin", "http://" + host()},
                                           {"Content-Type", "application/json"},
                                           {"X-Palpa-Page", key},
                                           {"X-Palpa-Write", newNumber()},
                                           {"Content-Length", std::to_string(body.size())}})
    all.emplace_back(name, value);
  return all;
}

Answer Console::raw(const std::string& bytes, const std::string& from) {
  Wire wire(port_, from);
  wire.send(bytes);
  return answerIn(wire.read(60s));
}

Answer Console::get(const std::string& path) {
  Answer answer;
  inTime([&] {
    answer = raw(requestOf("GET", path, readHeaders()));
    return answer.status != 0 && answer.status != 503;
  });
  return answer;
}

Answer Console::post(const std::string& path, const nlohmann::json& body) {
  Answer answer;
  inTime([&] {
    answer = raw(requestOf("POST", path, writeHeaders(body.dump()), body.dump()));
    return answer.status != 0 && answer.status != 503 && answer.status != 429;
  });
  return answer;
}

std::vector<Event> Console::events(const std::string& session, const std::string& last,
                                   const std::function<bool(const std::vector<Event>&)>& enough) {
  Headers headers = readHeaders();
  if (!last.empty()) headers.emplace_back("Last-Event-ID", last);
  const std::string request = requestOf("GET", "/api/sessions/" + session + "/live", headers);
  Wire wire(port_);
  wire.send(request);
  std::vector<Event> all;
  std::string bytes;
  inTime([&] {
    bytes += wire.readSome(1s);
    if (wire.closed() && answerIn(bytes).status == 503) {  // no place yet
      bytes.clear();
      wire = Wire(port_);
      wire.send(request);
    }
    for (Event& event : eventsIn(bytes)) all.push_back(std::move(event));
    return wire.closed() || enough(all);
  });
  return all;
}

}  // namespace palpa::console_attack
