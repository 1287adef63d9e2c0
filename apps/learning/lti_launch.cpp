#include "apps/learning/lti_launch.h"

#include <algorithm>

#include "anatomy/base/error.h"
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

}  // namespace palpa::learning
