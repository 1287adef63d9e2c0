#include "apps/learning/lti_launch.h"

#include <algorithm>

#include "anatomy/base/error.h"
#include "anatomy/base/uuid.h"
#include "apps/learning/signed_token.h"
#include "apps/link/web_client.h"

namespace palpa::learning {
namespace {

using nlohmann::json;
constexpr std::int64_t kLeeway_s = 60;

[[noreturn]] void refuseClaims(const std::string& why) {
  throw UsageError(why, "the platform's token", "Start again from the course");
}

/// A claim of LTI's own.
const json& claim(const json& claims, const std::string& name) {
  static const json none;
  const auto found = claims.find("https://purl.imsglobal.org/spec/lti/claim/" + name);
  return found == claims.end() ? none : *found;
}

std::string wordIn(const json& object, const char* field) {
  const auto found = object.is_object() ? object.find(field) : object.end();
  return object.is_object() && found != object.end() && found->is_string()
             ? found->get<std::string>()
             : "";
}

bool isAmong(const json& one_or_more, const std::string& wanted) {
  if (one_or_more.is_string()) return one_or_more == wanted;
  return one_or_more.is_array() &&
         std::find(one_or_more.begin(), one_or_more.end(), wanted) != one_or_more.end();
}

void requireForUs(const json& claims, const Platform& platform) {
  if (wordIn(claims, "iss") != platform.issuer) refuseClaims("is of another platform");
  const json audience = claims.value("aud", json());
  if (!isAmong(audience, platform.client_id)) refuseClaims("is for another tool");
  const std::string party = wordIn(claims, "azp");
  if (party.empty() ? audience.is_array() && audience.size() > 1 : party != platform.client_id)
    refuseClaims("was made for another tool");
  const std::vector<std::string>& known = platform.deployments;
  const json& deployment = claim(claims, "deployment_id");
  if (!deployment.is_string() || std::find(known.begin(), known.end(), deployment) == known.end())
    refuseClaims("comes from a place of the platform that is not configured here");
}

void requireNow(const json& claims, const std::string& nonce, std::int64_t now_s) {
  const auto secondsAt = [&](const char* field) {
    const json value = claims.value(field, json());
    if (!value.is_number()) refuseClaims(std::string("lacks a time: ") + field);
    return value.get<double>();
  };
  const auto now = static_cast<double>(now_s);
  if (secondsAt("exp") < now - kLeeway_s) refuseClaims("has expired");
  if (secondsAt("iat") > now + kLeeway_s)
    refuseClaims("was made in the future: a clock is wrong, here or there");
  if (claims.contains("nbf") && secondsAt("nbf") > now + kLeeway_s)
    refuseClaims("is not valid yet: a clock is wrong, here or there");
  if (wordIn(claims, "nonce") != nonce) refuseClaims("is for another login");
}

bool isOrigin(const std::string& url, const Platform& platform) {
  try {
    const std::string origin = originOf(url);
    return origin == originOf(platform.login) || origin == originOf(platform.token) ||
           origin == originOf(platform.keys);
  } catch (const UsageError&) {
    return false;
  }
}

std::string taskIn(const json& claims, const Settings& settings) {
  if (std::string task = wordIn(claim(claims, "custom"), "task"); !task.empty()) return task;
  const json& target = claim(claims, "target_link_uri");
  const std::string before = settings.address + "learning/lti/";
  const std::string link = target.is_string() ? target.get<std::string>() : "";
  if (!link.starts_with(before)) refuseClaims("opens nothing of this console");
  return link.substr(before.size(), link.find_first_of("?#") - before.size());
}

/// Empty where the platform wants no score of us.
std::string lineItemIn(const json& claims, const Platform& platform) {
  const auto found = claims.find("https://purl.imsglobal.org/spec/lti-ags/claim/endpoint");
  if (found == claims.end() || !isAmong(found->is_object() ? found->value("scope", json()) : json(),
                                        "https://purl.imsglobal.org/spec/lti-ags/scope/score"))
    return "";
  const std::string item = wordIn(*found, "lineitem");
  return isOrigin(item, platform) ? item : "";
}

}  // namespace

LtiLaunch readLtiLaunch(const json& claims, const Platform& platform, const std::string& nonce,
                        std::chrono::sys_seconds now, const Settings& settings) {
  requireForUs(claims, platform);
  requireNow(claims, nonce, now.time_since_epoch().count());
  if (claim(claims, "message_type") != "LtiResourceLinkRequest" ||
      claim(claims, "version") != "1.3.0")
    refuseClaims("is no launch of LTI 1.3");
  LtiLaunch launch;
  launch.person = wordIn(claims, "sub");
  if (launch.person.empty()) refuseClaims("names nobody: the course must not be open to guests");
  launch.task = taskIn(claims, settings);
  launch.return_url = wordIn(claim(claims, "launch_presentation"), "return_url");
  if (!isOrigin(launch.return_url, platform)) launch.return_url.clear();
  launch.line_item = lineItemIn(claims, platform);
  return launch;
}

std::string PlatformKeys::keysFor(const Platform& platform, const std::string& token, Time now) {
  constexpr std::chrono::minutes kRest{1};
  const std::lock_guard lock(mutex_);
  Known& known = known_[platform.name];
  if (holdsKeyOf(token, known.keys)) return known.keys;
  if (known.asked != Time() && now - known.asked < kRest) return known.keys;
  known.asked = now;
  const Target target = targetOf(platform.keys);
  link::WebClient client(target.server, kPlatformTimes);
  const link::WebAnswer answer = client.answerTo({.path = target.path});
  if (answer.status != 200)
    throw UsageError(
        "cannot be had (" +
            (answer.status == 0 ? answer.trouble : "it answers " + std::to_string(answer.status)) +
            ")",
        "the platform's keys", "Try again in a minute; else the educator looks at its address");
  known.keys = answer.body;
  return known.keys;
}

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
