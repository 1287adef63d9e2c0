#include "apps/learning/cmi5_launch.h"

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/text_forms.h"
#include "anatomy/base/uuid.h"
#include "apps/learning/cmi5_statements.h"
#include "apps/link/lrs_client.h"

namespace palpa::learning {
namespace {

using nlohmann::json;
constexpr char kAgain[] = "Start again from the course";

[[noreturn]] void refuseLaunch(const std::string& why, const std::string& what) {
  throw UsageError(why, what, kAgain);
}

std::string textAt(const json& object, const char* field) {
  return object.is_object() && object.value(field, json()).is_string()
             ? object[field].get<std::string>()
             : "";
}

/// Whom the platform launches for; only an account is a person here (section 9.2).
json actorIn(const std::string& text) {
  const json given = parsedOrDiscarded(text);
  const json account = given.is_object() ? given.value("account", json()) : json();
  const std::string home = textAt(account, "homePage"), name = textAt(account, "name");
  if (home.empty() || name.empty() ||
      (given.contains("objectType") && given["objectType"] != "Agent"))
    refuseLaunch("is no agent with an account", "the actor of the launch");
  return {{"objectType", "Agent"}, {"account", {{"homePage", home}, {"name", name}}}};
}

std::string iriIn(const Fields& fields, const char* name) {
  std::string iri = neededIn(fields, name);
  const std::size_t colon = iri.find(':');
  if (colon == std::string::npos || colon == 0 ||
      iri.find_first_of(" <>\"\r\n") != std::string::npos)
    refuseLaunch("is no IRI in full", std::string("\"") + name + "\" of the launch");
  return iri;
}

}  // namespace

std::string Cmi5Request::person() const { return actor.at("account").dump(); }

Cmi5Request readCmi5Request(const Fields& fields, const Settings& settings) {
  Cmi5Request r;
  r.endpoint = neededIn(fields, "endpoint");
  r.fetch = neededIn(fields, "fetch");
  r.activity = iriIn(fields, "activityId");
  r.registration = neededIn(fields, "registration");
  r.actor = actorIn(neededIn(fields, "actor", 4'000));
  if (!isUuid(r.registration)) refuseLaunch("is no UUID", "the registration of the launch");
  r.platform = settings.ofOrigin(r.endpoint);
  if (!r.platform || settings.ofOrigin(r.fetch) != r.platform)
    throw UsageError("is not one that may launch tasks here", "this learning platform",
                     "The educator adds it at the station: palpa console learning cmi5 --help");
  return r;
}

namespace {

LaunchMode modeIn(const json& document) {
  const std::string mode = textAt(document, "launchMode");
  if (mode == "Normal") return LaunchMode::normal;
  if (mode == "Browse") return LaunchMode::browse;
  if (mode == "Review") return LaunchMode::review;
  refuseLaunch("names no launch mode", "the platform's launch data");
}

std::optional<double> masteryIn(const json& document) {
  if (!document.contains("masteryScore")) return std::nullopt;
  const json& score = document["masteryScore"];
  if (!score.is_number() || score.get<double>() < 0 || score.get<double>() > 1)
    refuseLaunch("names a mastery score that is not from 0 to 1", "the platform's launch data");
  return score.get<double>();
}

/// Nobody is sent to another place than where they came from.
std::string returnIn(const json& document, const Platform& platform) {
  std::string url = textAt(document, "returnURL");
  try {
    return !url.empty() && originOf(url) == originOf(platform.origin) ? url : "";
  } catch (const UsageError&) {
    return "";
  }
}

}  // namespace

LaunchData readLaunchData(const json& document, const Platform& platform) {
  LaunchData data;
  if (!document.is_object()) refuseLaunch("are none", "the platform's launch data");
  data.context = document.value("contextTemplate", json());
  const json extensions =
      data.context.is_object() ? data.context.value("extensions", json()) : json();
  if (textAt(extensions, kSessionId).empty())
    refuseLaunch("name no session", "the platform's launch data");
  data.mode = modeIn(document);
  data.mastery = masteryIn(document);
  data.return_url = returnIn(document, platform);
  return data;
}

namespace {

/// Usable once: an answer that was lost is a launch that is lost.
std::string fetchedToken(const std::string& fetch) {
  const Target target = targetOf(fetch);
  link::WebClient client(target.server, kPlatformTimes);
  const link::WebAnswer answer = client.answerTo({.method = "POST", .path = target.path});
  if (answer.status == 0) refuseLaunch("gave no key (" + answer.trouble + ")", "the platform");
  const json told = parsedOrDiscarded(answer.body);
  std::string token = textAt(told, "auth-token");
  const bool fits = token.find_first_not_of(
                        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                        "0123456789-._~+/=") == std::string::npos;
  if (answer.status != 200 || token.empty() || !fits)
    refuseLaunch("gave no key: \"" + plainText(textAt(told, "error-text"), 80) +
                     "\" (each launch has one, for one use)",
                 "the platform");
  return token;
}

json documentAt(link::LrsClient& client, const std::string& resource, const char* what,
                bool may_lack) {
  const link::LrsAnswer answer = client.read(resource);
  if (answer.status == 404 && may_lack) return json::object();
  if (answer.status != 200)
    refuseLaunch(
        "cannot be had (" +
            (answer.status == 0 ? answer.trouble : "it answers " + std::to_string(answer.status)) +
            ")",
        what);
  return parsedOrDiscarded(answer.body);
}

}  // namespace

Cmi5Session askPlatform(const Cmi5Request& r) {
  Cmi5Session session;
  session.token = fetchedToken(r.fetch);
  link::LrsClient client(link::endpointOf(r.endpoint, false), {.token = session.token},
                         kPlatformTimes);
  const std::string agent = r.actor.dump();
  session.data =
      readLaunchData(documentAt(client,
                                "/activities/state?" + queryOf({{"stateId", "LMS.LaunchData"},
                                                                {"activityId", r.activity},
                                                                {"agent", agent},
                                                                {"registration", r.registration}}),
                                "the platform's launch data", false),
                     *r.platform);
  const json preferences = documentAt(
      client,
      "/agents/profile?" + queryOf({{"profileId", "cmi5LearnerPreferences"}, {"agent", agent}}),
      "the learner's preferences", true);
  session.data.audio = textAt(preferences, "audioPreference") != "off";
  return session;
}

}  // namespace palpa::learning
