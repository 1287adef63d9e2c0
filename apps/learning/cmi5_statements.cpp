#include "apps/learning/cmi5_statements.h"

#include "anatomy/base/utc.h"
#include "anatomy/base/uuid.h"
#include "apps/link/statement.h"

namespace palpa::learning {
namespace {

using nlohmann::json;

json activity(const char* id) { return {{"id", id}}; }

/// The template stays as it is; what a statement of cmi5 must say is added.
json contextOf(const Cmi5Facts& facts, bool moves_on, bool judged) {
  json context = facts.context;
  context["registration"] = facts.registration;
  json& category = context["contextActivities"]["category"];
  if (category.is_object()) category = json::array({category});
  const auto add = [&](const char* id) {
    for (const json& there : category)
      if (there.value("id", "") == id) return;
    category.push_back(activity(id));
  };
  add(kCmi5Category);
  if (moves_on) add(kMoveOnCategory);
  if (judged && facts.mastery) context["extensions"][kMasteryScore] = *facts.mastery;
  return context;
}

/// `since_ms`: after the beginning of the launch.
json statementFor(const Cmi5Facts& facts, const std::string& verb, std::int64_t since_ms) {
  constexpr std::int64_t kNsOfMs = 1'000'000;
  const bool judged = verb == "passed" || verb == "failed";
  const std::int64_t thousandths = std::stoll(facts.began_utc.substr(20, 3));
  return {{"id", uuidOfName(facts.launch, verb)},
          {"actor", facts.actor},
          {"verb", {{"id", kVerbRoot + verb}, {"display", {{"en", verb}}}}},
          {"object", {{"objectType", "Activity"}, {"id", facts.activity}}},
          {"context", contextOf(facts, judged || verb == "completed", judged)},
          {"timestamp",
           isoTimestamp(facts.began_utc.substr(0, 19) + "Z", (thousandths + since_ms) * kNsOfMs)}};
}

json scoreOf(double scaled) {
  constexpr double kPercent = 100;
  return {{"scaled", scaled}, {"raw", kPercent * scaled}, {"min", 0}, {"max", kPercent}};
}

}  // namespace

json toJson(const Cmi5Facts& f) {
  return {{"launch", f.launch},
          {"actor", f.actor},
          {"context", f.context},
          {"activity", f.activity},
          {"registration", f.registration},
          {"counts", f.counts},
          {"mastery", f.mastery ? json(*f.mastery) : json()},
          {"began_utc", f.began_utc}};
}

Cmi5Facts cmi5FactsIn(const json& j) {
  Cmi5Facts f;
  f.launch = j.at("launch");
  f.actor = j.at("actor");
  f.context = j.at("context");
  f.activity = j.at("activity");
  f.registration = j.at("registration");
  f.counts = j.at("counts");
  if (j.at("mastery").is_number()) f.mastery = j.at("mastery").get<double>();
  f.began_utc = j.at("began_utc");
  return f;
}

double masteryOf(const Cmi5Facts& facts) { return facts.mastery.value_or(1); }

json initialized(const Cmi5Facts& facts) { return statementFor(facts, "initialized", 0); }

std::vector<json> statementsAtEnd(const Cmi5Facts& facts, const LaunchResult& result,
                                  const ToldBefore& before) {
  std::vector<json> all;
  const auto add = [&](const char* verb) -> json& {
    // One instant after the other: their order is to be seen in their times, too
    const auto after = static_cast<std::int64_t>(all.size());
    json& one = all.emplace_back(statementFor(facts, verb, result.length_ms + after));
    one["result"]["duration"] = isoDuration(1e-3 * static_cast<double>(result.length_ms));
    return one["result"];
  };
  if (facts.counts && result.completed && !before.completed) add("completed")["completion"] = true;
  if (facts.counts && result.scaled && !before.passed) {
    const bool passed = *result.scaled >= masteryOf(facts);
    json& judged = add(passed ? "passed" : "failed");
    judged["success"] = passed;
    judged["score"] = scoreOf(*result.scaled);
    if (result.simulated)
      judged["extensions"][std::string(link::kNames) + "/extensions/simulated"] = true;
  }
  add("terminated");
  return all;
}

}  // namespace palpa::learning
