#include "apps/link/statement.h"

#include <cmath>

#include "anatomy/base/utc.h"
#include "anatomy/base/uuid.h"
#include "apps/training/trial_words.h"

namespace palpa::link {

using training::Outcome;

namespace {

using nlohmann::json;

constexpr char kVerbs[] = "http://adlnet.gov/expapi/verbs/";

std::string named(const std::string& path) { return std::string(kNames) + "/" + path; }

/// A part of an IRI: what is no letter, digit or dash becomes a dash.
std::string slug(const std::string& text) {
  std::string part;
  for (const char c : text)
    part += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' ? c : '-';
  return part.empty() ? "unnamed" : part;
}

json verb(const std::string& name) { return {{"id", kVerbs + name}, {"display", {{"en", name}}}}; }

/// Nobody passes with a punctured lung or artery, whatever else was reached.
bool harmed(const record::StoredTrial& t) {
  return t.metric("pleural_punctures") > 0 || t.metric("arterial_punctures") > 0;
}

std::string verbOf(const record::StoredTrial& t) {
  const Outcome outcome = training::outcomeNamed(t.outcome);
  if (outcome == Outcome::aborted) return "terminated";
  if (!training::countsAsScored(training::roleNamed(t.role)) || outcome == Outcome::not_scored)
    return "completed";
  return t.success && !harmed(t) ? "passed" : "failed";
}

json activityOf(const record::StoredSession& s) {
  const std::string mark = s.simulated ? " (simulated)" : "";
  return {{"objectType", "Activity"},
          {"id", named("activities/" + slug(s.task) + (s.simulated ? "/simulated" : ""))},
          {"definition",
           {{"name", {{"en", s.task + mark}}},
            {"type", "http://adlnet.gov/expapi/activities/simulation"}}}};
}

/// Empty where there is none.
json scoreOf(const record::StoredTrial& t) {
  const double total = t.metric("total"), found = t.metric("sensitivity_pct");
  if (std::isfinite(total) && total >= 0) return {{"raw", total}, {"min", 0}};
  if (std::isfinite(found) && found >= 0 && found <= 100)
    return {{"raw", found}, {"min", 0}, {"max", 100}, {"scaled", found / 100}};
  return nullptr;
}

json resultOf(const record::StoredTrial& t) {
  const double seconds = t.metric("time_s");
  json result{{"success", t.success},
              {"completion", training::outcomeNamed(t.outcome) != Outcome::aborted},
              {"duration", isoDuration(std::isfinite(seconds)
                                           ? seconds
                                           : 1e-9 * static_cast<double>(t.end_ns - t.start_ns))}};
  const json score = scoreOf(t);
  if (!score.is_null()) result["score"] = score;
  json& more = result["extensions"] = {{named("extensions/outcome"), t.outcome}};
  if (!t.reason.empty()) more[named("extensions/reason")] = t.reason;
  if (score.contains("raw"))
    more[named("extensions/score-means")] =
        score.contains("scaled") ? "lumps found in per cent" : "total penalty: lower is better";
  for (const record::Metric& m : t.metrics)
    if (std::isfinite(m.value)) more[named("figures/" + slug(m.name))] = m.value;
  return result;
}

json contextOf(const record::StoredSession& s, const record::StoredTrial& t) {
  json context{{"registration", s.uuid}, {"platform", s.software}};
  context["extensions"] = {{named("extensions/simulated"), s.simulated},
                           {named("extensions/role"), t.role},
                           {named("extensions/trial"), t.number},
                           {named("extensions/force-feedback"), t.force_feedback}};
  if (!s.study.empty())
    context["contextActivities"]["grouping"] = {
        {{"objectType", "Activity"}, {"id", named("studies/" + slug(s.study))}}};
  return context;
}

json valueAt(const json& statement, const char* pointer) {
  const json::json_pointer at(pointer);
  return statement.contains(at) ? statement.at(at) : json();
}

/// UTC to the millisecond, however its zone and fraction are written; other zones are compared as
/// they stand.
std::string instantOf(const json& statement) {
  std::string text = statement.value("timestamp", "");
  if (text.ends_with("+00:00")) text.replace(text.size() - 6, 6, "Z");
  if (const std::size_t point = text.find('.'); point != std::string::npos && text.ends_with("Z"))
    text = (text.substr(0, point) +
            (text.substr(point, text.size() - 1 - point) + "000").substr(0, 4)) +
           "Z";
  return text;
}

}  // namespace

json statementOf(const record::StoredSession& s, const record::StoredTrial& t,
                 const std::string& home_page) {
  json statement{
      {"id", statementId(s.uuid, t.number)},
      {"actor",
       {{"objectType", "Agent"}, {"account", {{"homePage", home_page}, {"name", s.trainee}}}}},
      {"verb", verb(verbOf(t))},
      {"object", activityOf(s)},
      {"result", resultOf(t)},
      {"context", contextOf(s, t)}};
  if (const std::string when = isoTimestamp(s.started_utc, t.end_ns); !when.empty())
    statement["timestamp"] = when;
  return statement;
}

json voidingOf(const std::string& statement) {
  return {{"id", voidingId(statement)},
          {"actor",
           {{"objectType", "Agent"},
            {"account", {{"homePage", named("programs")}, {"name", "palpa"}}}}},
          {"verb", verb("voided")},
          {"object", {{"objectType", "StatementRef"}, {"id", statement}}}};
}

bool saysTheSame(const json& told, const json& stored) {
  if (!stored.is_object()) return false;
  for (const char* at : {"/id", "/actor/account", "/verb/id", "/object/id", "/result",
                         "/context/registration", "/context/extensions"})
    if (valueAt(told, at) != valueAt(stored, at)) return false;
  return !told.contains("timestamp") || instantOf(told) == instantOf(stored);
}

std::string statementId(const std::string& session, std::int64_t trial) {
  return uuidOfName(session, "trial " + std::to_string(trial));
}

std::string voidingId(const std::string& statement) { return uuidOfName(statement, "voided"); }

}  // namespace palpa::link
