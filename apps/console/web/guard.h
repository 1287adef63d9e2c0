#pragma once

#include <deque>
#include <filesystem>
#include <mutex>
#include <string>
#include <unordered_set>
#include <vector>

#include "apps/console/web/own_door.h"

/// Who may ask the console what. Judged from the request alone, before anything is done for it.
namespace palpa::console {

/// The console's own id of a session or job: letters, digits, - and _, at most 64; else it is no
/// id, and no path is made of it.
bool isId(const std::string& text);

/// What of a request is judged.
struct GuardedRequest {
  std::string remote;  ///< address it came from
  std::string method, path;
  std::string host, origin, fetch_site, content_type, cookie, page_key,
      write_id;  ///< of its headers; empty: none
};

struct GuardVerdict {
  int status = 200;   ///< 200: it may pass
  std::string words;  ///< else why not
};

/// "/api/sessions/ID/stop": the emergency stop, before which no limit of writes stands.
bool isStopPath(const std::string& path);

/// The newest picture of this station's session, for whoever has the key that the room was told.
extern const char* const kRoomPicture;

/// Refuses foreign hosts (a page elsewhere whose name was bent to this address), foreign origins,
/// writes without the page's key or with a number that was used before, floods, and everybody who
/// has not given the token where one is asked for. Any thread.
class Guard {
 public:
  /// `token`: empty: none is asked for.
  explicit Guard(std::string token);
  /// Names with port by which the console may be called; before it is asked anything. Until then
  /// nobody may.
  void answerTo(std::vector<std::string> hosts, std::string scheme = "http") {
    hosts_ = std::move(hosts);
    scheme_ = std::move(scheme);
  }

  GuardVerdict judge(const GuardedRequest& asked);
  /// An emergency stop by somebody who may; whether its number was used is not looked at. Waits for
  /// nothing, not even another thread.
  bool mayStop(const GuardedRequest& asked) const;
  /// The cookie for whoever gave the right token; empty: wrong, or too many wrong ones came from
  /// there.
  std::string enter(const std::string& remote, const std::string& token);
  bool entered(const std::string& cookie_header) const;
  const std::string& pageKey() const { return page_key_; }
  /// "Set-Cookie" of a cookie that no script sees and no other site sends; `more`: further parts.
  std::string cookieText(const std::string& name, const std::string& value,
                         const std::string& more = "") const;
  /// The same for a browser that a learning platform sends on to us: it comes from another site.
  std::string cookieForLaunch(const std::string& name, const std::string& value) const;
  bool asksForToken() const { return !token_.empty(); }
  /// By which trainees come to "/api/mine" and what lies under it, and to nothing else.
  OwnDoor& own() { return own_; }

 private:
  GuardVerdict judgeLaunch(const GuardedRequest& asked);
  GuardVerdict judgeHost(const GuardedRequest& asked) const;
  GuardVerdict judgeOrigin(const GuardedRequest& asked) const;
  GuardVerdict judgePage(const GuardedRequest& asked) const;
  GuardVerdict judgeNumber(const GuardedRequest& asked);

  std::vector<std::string> hosts_;
  std::string scheme_ = "http";
  const std::string token_, page_key_, cookie_;
  mutable std::mutex mutex_;
  std::unordered_set<std::string> written_;  ///< numbers of writes
  std::deque<std::string> order_;            ///< of those, oldest first
  Tries writes_{60, std::chrono::seconds(10)}, wrong_{5, std::chrono::seconds(60)},
      launches_{60, std::chrono::seconds(10)};
  OwnDoor own_;
};

/// 128 random bits, hexadecimal.
std::string randomKey();

/// Headers that every answer carries: what a page may load, that nobody may frame or guess it.
const std::vector<std::pair<std::string, std::string>>& safeHeaders();
/// Of a report, which is a page of its own: no script, no network.
extern const char* const kReportPolicy;

/// What was refused, to whom and why, in a file that does not grow beyond a megabyte or two; never
/// a token, cookie, query or body.
class Refusals {
 public:
  explicit Refusals(std::filesystem::path file) : file_(std::move(file)) {}
  void note(const std::string& remote, const std::string& method, const std::string& path,
            int status, const std::string& words);

 private:
  const std::filesystem::path file_;
  std::mutex mutex_;
};

}  // namespace palpa::console
