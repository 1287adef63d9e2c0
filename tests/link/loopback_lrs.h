#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

namespace palpa::link_test {

/// What goes wrong with a request.
enum class Mishap {
  none,
  drop_before,  ///< the connection breaks, nothing was stored
  drop_after,   ///< it was stored, and the answer is lost
  error_500,
  slow,           ///< longer than anybody waits; stored
  login_page,     ///< 200 and a page, as a network's portal answers
  unlike_an_lrs,  ///< 204 without a version
  too_many        ///< 429
};

/// A learning record store on this computer that holds every rule of xAPI 1.0.3 against what it is
/// sent, and has mishaps when asked. What it stored outlives `stop`.
class LoopbackLrs {
 public:
  LoopbackLrs();
  ~LoopbackLrs();
  void start();  ///< at the same port again
  void stop();
  std::string url() const;

  /// Of the n-th PUT from 0; called in the server's threads. Set before start.
  std::function<Mishap(int)> mishap = [](int) { return Mishap::none; };
  /// 409 for what it has already, even if it is the same; else 204
  bool conflicts_on_same = false;
  std::string user = "teacher", password = "secret";  ///< empty user: anybody

  struct Stored {  // NOLINT(bugprone-exception-escape): JSON, of which it is made, throws none
    nlohmann::json statement;
    int times = 0;  ///< stored anew: more than once would be a fault of the server
    bool voided = false;
  };
  std::map<std::string, Stored> stored() const;
  std::vector<std::string> complaints() const;  ///< rules that were broken
  int puts() const { return puts_; }
  void keep(const nlohmann::json& statement);  ///< as if somebody had stored it

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  std::thread thread_;
  std::atomic<int> puts_{0};
  int port_ = 0;
};

}  // namespace palpa::link_test
