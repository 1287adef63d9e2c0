#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include <sys/types.h>

namespace httplib {
class Client;
}

namespace palpa::test {

/// A headless Chromium with a profile of its own, led by chromedriver (W3C WebDriver) on a port of
/// this process. Nothing it opens comes from a network.
class Browser {
 public:
  /// Empty: it can run here. Otherwise the reason, for a test to skip with.
  static std::string whyNot();

  Browser();  ///< throws std::runtime_error in words
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  /// The page as on a screen of this width, px, in a light or dark scheme, or as printed.
  void show(int width, const std::string& scheme = "light", const std::string& media = "screen");
  void open(const std::filesystem::path& page);
  nlohmann::json run(const std::string& script);      ///< the body of a function; what it returns
  void screenshot(const std::filesystem::path& png);  ///< of the whole page
  void print(const std::filesystem::path& pdf);       ///< on A4
  std::string complaints();  ///< what the page wrote to the console as errors, a line each

 private:
  nlohmann::json post(const std::string& what, const nlohmann::json& body);
  nlohmann::json devtools(const std::string& command, const nlohmann::json& parameters);

  std::filesystem::path profile_;
  pid_t driver_ = -1;
  std::unique_ptr<httplib::Client> client_;
  std::string session_;
};

}  // namespace palpa::test
