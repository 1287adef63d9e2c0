#include "tests/browser/browser.h"

#include <fcntl.h>
#include <httplib.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>

#include "tests/support/base64.h"

namespace palpa::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr char kDriver[] = "/usr/bin/chromedriver", kChromium[] = "/usr/bin/chromium";

/// The driver chooses a free port and says it: "... on port 40123."
int portSaidIn(const fs::path& log) {
  for (int tries = 300; tries > 0; --tries) {
    std::ifstream stream(log);
    const std::string said((std::istreambuf_iterator<char>(stream)),
                           std::istreambuf_iterator<char>());
    const std::size_t at = said.find("successfully on port ");
    if (at != std::string::npos && said.find('.', at) != std::string::npos)
      return std::stoi(said.substr(at + 21));
    ::usleep(100'000);
  }
  throw std::runtime_error("chromedriver did not start");
}

pid_t startDriver(const fs::path& log) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  const int output = ::open(log.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
  ::setpgid(0, 0);  // its browsers end with it
  ::execl(kDriver, kDriver, "--port=0", static_cast<char*>(nullptr));
  ::_exit(127);
}

json wanted(const fs::path& profile) {
  const json arguments{"--headless=new",
                       "--no-sandbox",
                       "--disable-gpu",
                       "--disable-quic",
                       "--no-first-run",
                       "--disable-background-networking",
                       "--disable-component-update",
                       "--disable-sync",
                       "--disable-dev-shm-usage",
                       "--hide-scrollbars",
                       "--force-color-profile=srgb",
                       "--user-data-dir=" + profile.string()};
  return {{"capabilities",
           {{"alwaysMatch",
             {{"browserName", "chrome"},
              {"goog:loggingPrefs", {{"browser", "ALL"}}},
              {"goog:chromeOptions", {{"binary", kChromium}, {"args", arguments}}}}}}}};
}

}  // namespace

std::string Browser::whyNot() {
  for (const char* program : {kDriver, kChromium})
    if (::access(program, X_OK) != 0)
      return std::string("no ") + program + " (Debian: chromium, chromium-driver)";
  return "";
}

Browser::Browser() {
  std::string name = (fs::temp_directory_path() / "palpa-browser-XXXXXX").string();
  if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  profile_ = name;
  driver_ = startDriver(profile_ / "driver.log");
  client_ = std::make_unique<httplib::Client>("127.0.0.1", portSaidIn(profile_ / "driver.log"));
  client_->set_read_timeout(120);
  session_ = post("", wanted(profile_ / "profile")).at("sessionId");
}

Browser::~Browser() {
  if (client_ && !session_.empty()) client_->Delete("/session/" + session_);
  if (driver_ > 0) {
    ::kill(-driver_, SIGKILL);
    ::waitpid(driver_, nullptr, 0);
  }
  std::error_code ignored;
  fs::remove_all(profile_, ignored);
}

json Browser::post(const std::string& what, const json& body) {
  const auto answer = client_->Post("/session" + (session_.empty() ? "" : "/" + session_) + what,
                                    body.dump(), "application/json");
  if (!answer) throw std::runtime_error("the browser does not answer (" + what + ")");
  json value = json::parse(answer->body).at("value");
  if (answer->status != 200) throw std::runtime_error(what + ": " + value.dump());
  return value;
}

json Browser::devtools(const std::string& command, const json& parameters) {
  return post("/goog/cdp/execute", {{"cmd", command}, {"params", parameters}});
}

void Browser::show(int width, const std::string& scheme, const std::string& media) {
  devtools("Emulation.setDeviceMetricsOverride",
           {{"width", width}, {"height", 900}, {"deviceScaleFactor", 1}, {"mobile", width < 600}});
  devtools("Emulation.setEmulatedMedia",
           {{"media", media},
            {"features", json::array({{{"name", "prefers-color-scheme"}, {"value", scheme}}})}});
}

void Browser::open(const fs::path& page) {
  post("/url", {{"url", "file://" + fs::absolute(page).string()}});
}

json Browser::run(const std::string& script) {
  return post("/execute/sync", {{"script", script}, {"args", json::array()}});
}

void Browser::screenshot(const fs::path& png) {
  const json size =
      run("const e = document.documentElement; return [e.clientWidth, e.scrollHeight]");
  const json picture = devtools(
      "Page.captureScreenshot",
      {{"captureBeyondViewport", true},
       {"clip", {{"x", 0}, {"y", 0}, {"width", size[0]}, {"height", size[1]}, {"scale", 1}}}});
  std::ofstream(png, std::ios::binary) << fromBase64(picture.at("data").get<std::string>());
}

void Browser::print(const fs::path& pdf) {
  const json printed = post("/print", {{"background", true},
                                       {"page", {{"width", 21.0}, {"height", 29.7}}},
                                       {"shrinkToFit", false}});
  std::ofstream(pdf, std::ios::binary) << fromBase64(printed.get<std::string>());
}

std::string Browser::complaints() {
  std::string all;
  for (const json& entry : post("/se/log", {{"type", "browser"}}))
    if (entry.value("level", "") == "SEVERE") all += entry.value("message", "") + "\n";
  return all;
}

}  // namespace palpa::test
