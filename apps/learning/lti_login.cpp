#include "apps/learning/lti_login.h"

#include <algorithm>

#include "anatomy/base/error.h"
#include "anatomy/base/uuid.h"

namespace palpa::learning {
namespace {

constexpr char kFromTheCourse[] = "Start again from the course";

/// Of the issuer, and of the client where the platform names one (a site may have several).
const Platform* issuedBy(const Settings& settings, const std::string& issuer,
                         const std::string& client) {
  const auto found = std::find_if(
      settings.platforms.begin(), settings.platforms.end(), [&](const Platform& platform) {
        return platform.kind == PlatformKind::lti && platform.issuer == issuer &&
               (client.empty() || platform.client_id == client);
      });
  return found == settings.platforms.end() ? nullptr : &*found;
}

}  // namespace

std::string launchAddress(const Settings& settings) {
  return settings.address + "learning/lti/launch";
}
std::string keysAddress(const Settings& settings) { return settings.address + "learning/keys"; }
std::string loginAddress(const Settings& settings) {
  return settings.address + "learning/lti/login";
}

LoginRequest readLogin(const Fields& fields, const Settings& settings) {
  LoginRequest request;
  request.platform = issuedBy(settings, neededIn(fields, "iss"), fieldIn(fields, "client_id"));
  if (!request.platform)
    throw UsageError("is not one that may launch tasks here", "this learning platform",
                     "The educator adds it at the station: palpa console learning --help");
  if (!neededIn(fields, "target_link_uri").starts_with(settings.address))
    throw UsageError("is not an address of this console", "what the platform wants to open",
                     "Correct the link in the course");
  request.hint = neededIn(fields, "login_hint");
  request.message_hint = fieldIn(fields, "lti_message_hint");
  return request;
}

Logins::Begun Logins::begin(const LoginRequest& request, const Settings& settings, Time now) {
  const std::string state = newUuid(), nonce = newUuid();
  Begun begun;
  begun.browser = newUuid();
  Fields fields{{"scope", "openid"},
                {"response_type", "id_token"},
                {"response_mode", "form_post"},
                {"prompt", "none"},
                {"client_id", request.platform->client_id},
                {"redirect_uri", launchAddress(settings)},
                {"login_hint", request.hint},
                {"state", state},
                {"nonce", nonce}};
  if (!request.message_hint.empty()) fields.emplace_back("lti_message_hint", request.message_hint);
  begun.address = withQuery(request.platform->login, fields);
  const std::lock_guard lock(mutex_);
  std::erase_if(pending_, [now](const auto& one) { return one.second.until < now; });
  if (pending_.size() >= kMost)
    pending_.erase(std::min_element(
        pending_.begin(), pending_.end(),
        [](const auto& a, const auto& b) { return a.second.until < b.second.until; }));
  pending_[state] = {{request.platform->name, nonce}, begun.browser, now + kLasts};
  return begun;
}

Logins::Pending Logins::take(const std::string& state, const std::string& browser, Time now) {
  const std::lock_guard lock(mutex_);
  const auto found = pending_.find(state);
  if (found == pending_.end() || found->second.until < now)
    throw UsageError("was used before, or came too late", "this launch", kFromTheCourse);
  const Kept kept = found->second;
  if (browser.empty() || kept.browser != browser)
    throw UsageError("began in another browser", "this launch", kFromTheCourse);
  pending_.erase(found);
  return kept.pending;
}

}  // namespace palpa::learning
