#include "apps/console/jobs.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>

#include "anatomy/base/error.h"
#include "anatomy/base/text_forms.h"
#include "apps/os/file_access.h"
#include "apps/os/real_time.h"
#include "apps/runtime/clock.h"

namespace palpa::console {
namespace {

namespace fs = std::filesystem;
constexpr std::chrono::milliseconds kLook{100};
constexpr std::size_t kShownLines = 12, kKeptJobs = 200;

/// Beyond so many folders the oldest go: all that is in them can be made again.
void clearOld(const fs::path& jobs) {
  std::vector<fs::path> all;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(jobs, none))
    if (isId(entry.path().filename().string())) all.push_back(entry.path());
  std::sort(all.begin(), all.end());
  for (std::size_t i = 0; i + kKeptJobs < all.size(); ++i) fs::remove_all(all[i], none);
}

}  // namespace

nlohmann::json fractionOf(const std::vector<std::string>& lines) {
  for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
    for (std::size_t of = line->find(" of "); of != std::string::npos;
         of = line->find(" of ", of + 1)) {
      std::size_t begin = of;
      while (begin > 0 && line->at(begin - 1) >= '0' && line->at(begin - 1) <= '9') --begin;
      int part = 0, whole = 0;
      if (std::sscanf(line->c_str() + begin, "%d of %d", &part, &whole) == 2 && whole > 0 &&
          part >= 0 && part <= whole)
        return static_cast<double>(part) / whole;
    }
  }
  return nullptr;
}

Jobs::Jobs(const ConsolePlace& place) : place_(place) {
  os::makeFolders(place_.jobs());  // the first job meets what is wrong
  clearOld(place_.jobs());
  thread_ = os::startThread([this] { run(); });
}

Jobs::~Jobs() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    for (auto& [id, job] : jobs_)
      if (job.state == JobState::running) os::askToEnd(job.process);
  }
  changed_.notify_all();
  thread_.join();
}

std::string Jobs::add(JobRequest request) {
  const std::lock_guard lock(mutex_);
  return addLocked(std::move(request));
}

nlohmann::json Jobs::ask(JobRequest request) {
  const std::string key = request.key;
  const bool pageless = request.page.empty();
  std::string id;
  {
    const std::lock_guard lock(mutex_);
    const auto found = asked_.find(key);
    id = found != asked_.end() ? found->second : asked_[key] = addLocked(std::move(request));
    // Somebody looks at its page now: it goes before what was asked for and left.
    if (const auto at = std::find(queue_.begin(), queue_.end(), id); at != queue_.end())
      std::rotate(queue_.begin(), at, at + 1);
  }
  nlohmann::json told = one(id);
  const bool page_gone = told["state"] == "done" && !pageless && told["page"] == "";
  if (page_gone)
    told["state"] = "working";  // with somebody who was deleted: asked again, it is made
  if (page_gone || told["state"] == "failed") {
    const std::lock_guard lock(mutex_);
    asked_.erase(key);
  }
  return told;
}

std::string Jobs::addLocked(JobRequest request) {
  for (const auto& [id, job] : jobs_)
    if (job.request.key == request.key &&
        (job.state == JobState::waiting || job.state == JobState::running))
      return id;
  std::string id = newId();
  jobs_[id].request = std::move(request);
  queue_.push_back(id);
  changed_.notify_all();
  return id;
}

void Jobs::run() {
  for (;;) {
    std::string id;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return ending_ || !queue_.empty(); });
      if (ending_) return;
      id = queue_.front();
      queue_.erase(queue_.begin());
    }
    perform(id);
  }
}

void Jobs::perform(const std::string& id) {
  const fs::path folder = place_.jobs() / id;
  std::error_code none;
  os::makeFolders(folder);
  os::ProcessId process;
  JobRequest request;
  {
    const std::lock_guard lock(mutex_);
    request = jobs_[id].request;
    std::vector<std::string> arguments = request.arguments;
    for (std::string& argument : arguments)
      if (const std::size_t at = argument.find("{}"); at != std::string::npos)
        argument.replace(at, 2, folder.string());
    if (!jobs_[id].stopped && !ending_) {
      try {
        process = jobs_[id].process = os::start(arguments, folder / "log.txt", true);
      } catch (const Error&) {
        process = {};
      }
    }
    jobs_[id].state = JobState::running;
  }
  while (os::runs(process)) runtime::rest(kLook);
  bool good = process.pid > 0 && complaintIn(folder / "log.txt").empty() &&
              (request.page.empty() || fs::exists(folder / request.page, none));
  try {
    if (request.then) request.then(folder, good);
  } catch (const std::exception&) {
    good = false;  // a full disk, say: the next command meets it as well, and tells
  }
  const std::lock_guard lock(mutex_);
  jobs_[id].state = good && !jobs_[id].stopped ? JobState::done : JobState::failed;
}

nlohmann::json Jobs::one(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto found = jobs_.find(id);
  if (found == jobs_.end())
    throw UsageError("is not known", "job " + id.substr(0, 64), "Start it again");
  const Job& job = found->second;
  const fs::path log = place_.jobs() / id / "log.txt";
  const auto lines = lastLines(log, kShownLines);
  std::error_code none;
  nlohmann::json one{{"id", id},
                     {"title", job.request.title},
                     {"state", job.state == JobState::done     ? "done"
                               : job.state == JobState::failed ? "failed"
                                                               : "working"},
                     {"lines", lines},
                     {"done", job.state == JobState::done ? nlohmann::json(1) : fractionOf(lines)},
                     {"message", ""},
                     {"picture", nullptr},
                     {"page", ""}};
  if (job.state == JobState::failed)
    one["message"] = job.stopped ? "It was stopped." : complaintIn(log);
  if (!job.request.picture.empty() && fs::exists(place_.jobs() / id / job.request.picture, none))
    one["picture"] = "/api/jobs/" + id + "/picture";
  if (!job.request.page.empty() && fs::exists(place_.jobs() / id / job.request.page, none))
    one["page"] = "/api/pages/" + id;
  return one;
}

void Jobs::stop(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto found = jobs_.find(id);
  if (found == jobs_.end())
    throw UsageError("is not known", "job " + id.substr(0, 64), "It has already ended");
  found->second.stopped = true;
  os::askToEnd(found->second.process);
}

fs::path Jobs::picture(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto found = jobs_.find(id);
  if (found == jobs_.end() || found->second.request.picture.empty())
    throw UsageError("is not here", "picture of " + id.substr(0, 64), "Load the page again");
  return place_.jobs() / id / found->second.request.picture;
}

fs::path Jobs::page(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto found = jobs_.find(id);
  if (found == jobs_.end() || found->second.request.page.empty())
    throw UsageError("is not here", "page of " + id.substr(0, 64), "Ask for it again");
  return place_.jobs() / id / found->second.request.page;
}

std::string Jobs::workingOn(const std::string& prefix) {
  const std::lock_guard lock(mutex_);
  for (const auto& [id, job] : jobs_)
    if (job.request.key.rfind(prefix, 0) == 0 &&
        (job.state == JobState::waiting || job.state == JobState::running))
      return id;
  return "";
}

namespace {

constexpr std::streamoff kTail = 16 << 10;
constexpr std::size_t kLongestLine = 1000;

}  // namespace

std::vector<std::string> lastLines(const std::filesystem::path& log, std::size_t most) {
  std::ifstream file(log, std::ios::binary | std::ios::ate);
  if (!file) return {};
  const std::streamoff size = file.tellg();
  file.seekg(std::max<std::streamoff>(0, size - kTail));
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (const std::size_t anew = line.rfind('\r'); anew != std::string::npos)
      line.erase(0, anew + 1);
    if (!line.empty()) lines.push_back(plainText(line, kLongestLine));
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

}  // namespace palpa::console
