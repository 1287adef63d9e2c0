#include "apps/console/web/guard.h"

#include <algorithm>
#include <sstream>

#include <openssl/crypto.h>
#include <openssl/rand.h>

#include "anatomy/base/error.h"
#include "apps/os/file_access.h"
#include "apps/runtime/clock.h"

namespace palpa::console {
namespace {

constexpr std::size_t kKeptNumbers = 20'000;

bool same(const std::string& a, const std::string& b) {
  return a.size() == b.size() && CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

bool isNumber(const std::string& id) {
  return id.size() == 32 && std::all_of(id.begin(), id.end(), [](char c) {
           return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
         });
}

}  // namespace

bool isId(const std::string& text) {
  constexpr std::size_t kLongest = 64;
  return !text.empty() && text.size() <= kLongest &&
         std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                  c == '-' || c == '_';
         });
}

const char* const kRoomPicture = "/api/room-picture";

const char* const kReportPolicy =
    "sandbox allow-modals allow-popups; default-src 'none'; style-src 'unsafe-inline'; img-src "
    "data:; base-uri 'none'; form-action 'none'; frame-ancestors 'self'";

std::string randomKey() {
  unsigned char bytes[16];
  if (RAND_bytes(bytes, sizeof bytes) != 1)
    throw Error("gives no random numbers", "this computer", "Restart it");
  std::string text;
  for (const unsigned char byte : bytes) {
    text += "0123456789abcdef"[byte >> 4];
    text += "0123456789abcdef"[byte & 15];
  }
  return text;
}

const std::vector<std::pair<std::string, std::string>>& safeHeaders() {
  static const std::vector<std::pair<std::string, std::string>> all{
      {"Content-Security-Policy",
       "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; "
       "connect-src 'self'; frame-src 'self'; font-src 'self'; base-uri 'none'; form-action "
       "'none'; frame-ancestors 'none'"},
      {"X-Content-Type-Options", "nosniff"},
      {"Referrer-Policy", "no-referrer"},
      {"Cross-Origin-Opener-Policy", "same-origin"},
      {"Cross-Origin-Resource-Policy", "same-origin"},
      {"Cache-Control", "no-store"}};
  return all;
}

bool isStopPath(const std::string& path) {
  constexpr std::string_view kBefore = "/api/sessions/", kAfter = "/stop";
  return path.size() > kBefore.size() + kAfter.size() && path.starts_with(kBefore) &&
         path.ends_with(kAfter) &&
         isId(path.substr(kBefore.size(), path.size() - kBefore.size() - kAfter.size()));
}

Guard::Guard(std::string token)
    : token_(std::move(token)), page_key_(randomKey()), cookie_(randomKey()) {}

bool Guard::entered(const std::string& cookie_header) const {
  return token_.empty() || same(cookieNamed("palpa", cookie_header), cookie_);
}

namespace {

/// What everybody gets, whoever they are and wherever they come from.
bool isPage(const GuardedRequest& asked) {
  return asked.method == "GET" && (asked.path == "/" || asked.path.rfind("/static/", 0) == 0);
}

/// And what asks by itself whom it may answer: the doors, what a trainee's key opens, and the
/// picture for who watches the room.
bool isOpen(const GuardedRequest& asked) {
  if (asked.method == "GET" && asked.path == kRoomPicture) return true;
  const bool own = asked.method == "GET" && asked.path.find("..") == std::string::npos &&
                   (asked.path == "/api/mine" || asked.path.rfind("/api/mine/", 0) == 0);
  return isPage(asked) || own || asked.path == "/api/me" || asked.path == "/api/enter" ||
         asked.path == "/api/mine/enter" || asked.path == "/api/mine/leave";
}

/// What a learning platform sends browsers to: from another site, by a form of theirs. What it has
/// signed, or a key of its for one use, is looked at by whoever answers.
bool isLaunchPath(const GuardedRequest& asked) {
  return asked.path.starts_with("/learning/") && asked.path.find("..") == std::string::npos;
}

}  // namespace

GuardVerdict Guard::judgeLaunch(const GuardedRequest& asked) {
  if (GuardVerdict verdict = judgeHost(asked); verdict.status != 200) return verdict;
  if (asked.method != "GET" && asked.method != "POST")
    return {405, "only GET and POST are understood"};
  if (asked.method == "POST" &&
      !asked.content_type.starts_with("application/x-www-form-urlencoded"))
    return {415, "a launch must be a form"};
  const std::lock_guard lock(mutex_);
  if (launches_.tooMany(asked.remote)) return {429, "too many requests: wait a few seconds"};
  launches_.note(asked.remote);
  return {};
}

GuardVerdict Guard::judge(const GuardedRequest& asked) {
  if (isLaunchPath(asked)) return judgeLaunch(asked);
  if (GuardVerdict verdict = judgeOrigin(asked); verdict.status != 200) return verdict;
  if (asked.method == "POST") {
    if (GuardVerdict verdict = judgePage(asked); verdict.status != 200) return verdict;
    if (GuardVerdict verdict = judgeNumber(asked); verdict.status != 200) return verdict;
  } else if (asked.method != "GET") {
    return {405, "only GET and POST are understood"};
  }
  if (!isOpen(asked) && !entered(asked.cookie)) return {401, "give the console's token first"};
  return {};
}

std::string Guard::cookieText(const std::string& name, const std::string& value,
                              const std::string& more) const {
  return name + "=" + value + "; HttpOnly; SameSite=Strict; Path=/" +
         (scheme_ == "https" ? "; Secure" : "") + more;
}

bool Guard::mayStop(const GuardedRequest& asked) const {
  return asked.method == "POST" && isStopPath(asked.path) && judgeOrigin(asked).status == 200 &&
         judgePage(asked).status == 200 && entered(asked.cookie);
}

std::string Guard::cookieForLaunch(const std::string& name, const std::string& value) const {
  return name + "=" + value + "; HttpOnly; Path=/learning/; " +
         (scheme_ == "https" ? "SameSite=None; Secure" : "SameSite=Lax");
}

GuardVerdict Guard::judgeHost(const GuardedRequest& asked) const {
  if (std::find(hosts_.begin(), hosts_.end(), asked.host) == hosts_.end())
    return {421, "this console is not called \"" + asked.host.substr(0, 64) +
                     "\": use the address that it prints when it starts"};
  return {};
}

GuardVerdict Guard::judgeOrigin(const GuardedRequest& asked) const {
  if (GuardVerdict verdict = judgeHost(asked); verdict.status != 200) return verdict;
  const bool own = asked.origin.empty() ||
                   std::any_of(hosts_.begin(), hosts_.end(), [&](const std::string& host) {
                     return asked.origin == scheme_ + "://" + host;
                   });
  if (!own) return {403, "requested by another site"};
  if (!asked.fetch_site.empty() && asked.fetch_site != "same-origin" &&
      !(asked.fetch_site == "none" && asked.method == "GET") && !isPage(asked))
    return {403, "requested by another site"};
  return {};
}

/// A write comes from a page of this console, and is one of its own.
GuardVerdict Guard::judgePage(const GuardedRequest& asked) const {
  if (asked.content_type.rfind("application/json", 0) != 0) return {415, "a write must be JSON"};
  if (!same(asked.page_key, page_key_))
    return {403, "not requested by a page of this console: load the page again"};
  if (!isNumber(asked.write_id)) return {400, "a write needs a number of its own"};
  return {};
}

/// And it comes once, and not with too many others.
GuardVerdict Guard::judgeNumber(const GuardedRequest& asked) {
  const std::lock_guard lock(mutex_);
  if (!isStopPath(asked.path)) {
    if (writes_.tooMany(asked.remote)) return {429, "too many requests: wait a few seconds"};
    writes_.note(asked.remote);
  }
  if (!written_.insert(asked.write_id).second) return {409, "this was requested before"};
  order_.push_back(asked.write_id);
  if (order_.size() > kKeptNumbers) {
    written_.erase(order_.front());
    order_.pop_front();
  }
  return {};
}

std::string Guard::enter(const std::string& remote, const std::string& token) {
  const std::lock_guard lock(mutex_);
  if (wrong_.tooMany(remote)) return "";
  if (token_.empty() || !same(token, token_)) {
    wrong_.note(remote);
    return "";
  }
  return cookie_;
}

namespace {

constexpr std::uintmax_t kLongest = 1u << 20;
constexpr std::size_t kLongestPart = 120;

/// In one line and short, whatever somebody sent.
std::string plain(const std::string& text) {
  std::string line = text.substr(0, kLongestPart);
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < 0x20 || c >= 0x7f; }, '?');
  return line;
}

/// One word of it: what was sent adds no words of its own.
std::string word(const std::string& text) {
  std::string one = plain(text);
  std::replace(one.begin(), one.end(), ' ', '?');
  return one.empty() ? "-" : one;
}

}  // namespace

void Refusals::note(const std::string& remote, const std::string& method, const std::string& path,
                    int status, const std::string& words) {
  const std::lock_guard lock(mutex_);
  std::error_code none;
  if (std::filesystem::file_size(file_, none) > kLongest && !none)
    std::filesystem::rename(file_, file_.string() + ".1", none);
  std::ostringstream line;
  line << runtime::utcNow() << ' ' << word(remote) << ' ' << word(method) << ' '
       << word(path.substr(0, path.find('?'))) << ' ' << status << ' ' << plain(words) << '\n';
  os::appendPrivate(file_, line.str());  // on a full disk, say, nothing is noted
}

}  // namespace palpa::console
