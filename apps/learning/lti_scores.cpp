#include "apps/learning/lti_scores.h"

#include "anatomy/base/json_text.h"
#include "anatomy/base/uuid.h"
#include "apps/learning/web_text.h"
#include "apps/link/web_client.h"

namespace palpa::learning {
namespace {

using nlohmann::json;
constexpr char kScope[] = "https://purl.imsglobal.org/spec/lti-ags/scope/score";

/// By which the console shows the platform who it is.
std::string assertionFor(const Platform& platform, const SigningKey& key,
                         std::chrono::sys_seconds now) {
  constexpr std::int64_t kLasts_s = 300;
  const std::int64_t now_s = now.time_since_epoch().count();
  return key.signedToken({{"iss", platform.client_id},
                          {"sub", platform.client_id},
                          {"aud", platform.token},
                          {"iat", now_s},
                          {"exp", now_s + kLasts_s},
                          {"jti", newUuid()}});
}

/// "…/lineitem?x=1" -> "…/lineitem/scores?x=1".
std::string scoresOf(const std::string& line_item) {
  const std::size_t query = std::min(line_item.find('?'), line_item.size());
  return line_item.substr(0, query) + "/scores" + line_item.substr(query);
}

struct Access {
  std::string token;
  Delivered trouble;  ///< of none
};

Access accessFrom(const Platform& platform, const SigningKey& key, std::chrono::sys_seconds now,
                  const link::WebTimes& times) {
  const Target target = targetOf(platform.token);
  link::WebClient client(target.server, times);
  const link::WebAnswer answer =
      client.answerTo({.method = "POST",
                       .path = target.path,
                       .body = queryOf({{"grant_type", "client_credentials"},
                                        {"client_assertion_type",
                                         "urn:ietf:params:oauth:client-assertion-type:jwt-bearer"},
                                        {"client_assertion", assertionFor(platform, key, now)},
                                        {"scope", kScope}}),
                       .content_type = "application/x-www-form-urlencoded"});
  const json told = parsedOrDiscarded(answer.body);
  const json token = told.is_object() ? told.value("access_token", json()) : json();
  if (answer.status == 200 && token.is_string()) return {token, {}};
  // A key that the platform does not know yet is one that it may know in an hour
  Delivered trouble = deliveredBy(answer.status, answer.trouble);
  trouble.how = Delivery::later;
  trouble.words = "the platform gives no access to its scores: " + trouble.words;
  return {"", trouble};
}

}  // namespace

json scoreFrom(const ScoreFacts& facts) {
  constexpr double kPercent = 100;
  json score{{"userId", facts.person},
             {"scoreGiven", kPercent * facts.scaled},
             {"scoreMaximum", kPercent},
             {"timestamp", facts.time_utc},
             {"activityProgress", facts.completed ? "Completed" : "InProgress"},
             {"gradingProgress", "FullyGraded"}};
  if (facts.simulated) score["comment"] = "Simulated: this says nothing about a person";
  return score;
}

Delivered deliveredBy(int status, const std::string& trouble) {
  constexpr int kGood = 200, kNoMoreGood = 300, kConflict = 409;
  if (status >= kGood && status < kNoMoreGood) return {};
  if (status == kConflict) return {};  // it has it already
  const std::string words = status == 0 ? trouble : "it answers " + std::to_string(status);
  // Not allowed (yet), too slow, too many, or its own fault: another time.
  const bool for_good = status >= 400 && status < 500 && status != 401 && status != 403 &&
                        status != 408 && status != 425 && status != 429;
  return {for_good ? Delivery::refused : Delivery::later, words};
}

Delivered sendScore(const json& score, const std::string& line_item, const Platform& platform,
                    const SigningKey& key, std::chrono::sys_seconds now,
                    const link::WebTimes& times) {
  const Access access = accessFrom(platform, key, now, times);
  if (access.token.empty()) return access.trouble;
  const Target target = targetOf(scoresOf(line_item));
  link::WebClient client(target.server, times);
  const link::WebAnswer answer =
      client.answerTo({.method = "POST",
                       .path = target.path,
                       .body = score.dump(),
                       .content_type = "application/vnd.ims.lis.v1.score+json",
                       .headers = {{"Authorization", "Bearer " + access.token}}});
  return deliveredBy(answer.status, answer.trouble);
}

}  // namespace palpa::learning
