#include "tests/link/xapi_rules.h"

#include <regex>
#include <set>

namespace palpa::link_test {
namespace {

using nlohmann::json;
using Names = std::set<std::string>;

struct Broken : std::runtime_error {
  using std::runtime_error::runtime_error;
};

void require(bool held, const std::string& rule) {
  if (!held) throw Broken(rule);
}

bool matches(const std::string& text, const char* pattern) {
  return std::regex_match(text, std::regex(pattern));
}
bool isUuidText(const json& value) {
  return value.is_string() &&
         matches(value.get<std::string>(),
                 "[0-9a-f]{8}-[0-9a-f]{4}-[1-8][0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}");
}
bool isIriText(const json& value) { return value.is_string() && isIri(value.get<std::string>()); }

void onlyNames(const json& object, const Names& names, const std::string& where) {
  require(object.is_object(), where + " is no object");
  for (const auto& [name, value] : object.items())
    require(names.count(name) == 1, where + " has " + name + ", which the standard does not know");
}

/// 2.2: nothing is null but what is inside extensions.
void noNulls(const json& value, const std::string& where) {
  require(!value.is_null(), where + " is null");
  if (!value.is_structured()) return;
  for (const auto& [name, inner] : value.items())
    if (name != "extensions") noNulls(inner, where + "/" + name);
}

void languageMap(const json& map, const std::string& where) {
  require(map.is_object(), where + " is no language map");
  for (const auto& [language, text] : map.items())
    require(matches(language, "[A-Za-z]{2,3}(-[A-Za-z0-9]{2,8})*|und") && text.is_string(),
            where + " has no language tag or text");
}

void extensions(const json& map, const std::string& where) {
  require(map.is_object(), where + " is no object");
  for (const auto& [name, value] : map.items())
    require(isIri(name), where + " has a key that is no IRI: " + name);
}

/// 2.4.2: exactly one inverse functional identifier.
void agent(const json& actor, const std::string& where) {
  onlyNames(actor, {"objectType", "name", "mbox", "mbox_sha1sum", "openid", "account"}, where);
  require(!actor.contains("objectType") || actor["objectType"] == "Agent", where + " is no Agent");
  int identifiers = 0;
  for (const char* name : {"mbox", "mbox_sha1sum", "openid", "account"})
    identifiers += actor.contains(name);
  require(identifiers == 1,
          where + " has " + std::to_string(identifiers) + " identifiers instead of one");
  if (actor.contains("mbox"))
    require(actor["mbox"].is_string() && matches(actor["mbox"], "mailto:[^@ ]+@[^@ ]+"),
            where + " has no mailto address");
  if (actor.contains("mbox_sha1sum"))
    require(actor["mbox_sha1sum"].is_string() && matches(actor["mbox_sha1sum"], "[0-9a-f]{40}"),
            where + " has no SHA-1");
  if (actor.contains("openid")) require(isIriText(actor["openid"]), where + " has no openid");
  if (!actor.contains("account")) return;
  const json& account = actor["account"];
  onlyNames(account, {"homePage", "name"}, where + "/account");
  require(account.contains("homePage") && isIriText(account["homePage"]),
          where + "/account has no home page");
  require(account.contains("name") && account["name"].is_string() &&
              !account["name"].get<std::string>().empty(),
          where + "/account has no name");
}

void activity(const json& object, const std::string& where) {
  onlyNames(object, {"objectType", "id", "definition"}, where);
  require(object.contains("id") && isIriText(object["id"]), where + " has no IRI");
  if (!object.contains("definition")) return;
  const json& definition = object["definition"];
  onlyNames(definition, {"name", "description", "type", "moreInfo", "extensions"},
            where + "/definition");
  for (const char* name : {"name", "description"})
    if (definition.contains(name)) languageMap(definition[name], where + "/definition/" + name);
  for (const char* name : {"type", "moreInfo"})
    if (definition.contains(name))
      require(isIriText(definition[name]), where + "/definition/" + name + " is no IRI");
  if (definition.contains("extensions")) extensions(definition["extensions"], where);
}

void object(const json& statement) {
  const json& object = statement["object"];
  require(object.is_object(), "object is no object");
  const std::string type = object.value("objectType", "Activity");
  const bool voids = statement["verb"]["id"] == "http://adlnet.gov/expapi/verbs/voided";
  require(!voids || type == "StatementRef", "voided needs a StatementRef");
  if (type == "StatementRef") {
    onlyNames(object, {"objectType", "id"}, "object");
    require(object.contains("id") && isUuidText(object["id"]), "object refers to no UUID");
  } else if (type == "Activity") {
    activity(object, "object");
  } else {
    agent(object, "object");
  }
}

void score(const json& s) {
  onlyNames(s, {"scaled", "raw", "min", "max"}, "score");
  for (const auto& [name, value] : s.items())
    require(value.is_number(), "score/" + name + " is no number");
  if (s.contains("scaled"))
    require(s["scaled"] >= -1 && s["scaled"] <= 1, "score/scaled is not between -1 and 1");
  if (s.contains("min") && s.contains("max"))
    require(s["min"] < s["max"], "score/min is not below max");
  if (s.contains("raw") && s.contains("min"))
    require(s["raw"] >= s["min"], "score/raw is below min");
  if (s.contains("raw") && s.contains("max"))
    require(s["raw"] <= s["max"], "score/raw is above max");
}

void result(const json& r) {
  onlyNames(r, {"score", "success", "completion", "response", "duration", "extensions"}, "result");
  if (r.contains("score")) score(r["score"]);
  for (const char* name : {"success", "completion"})
    if (r.contains(name))
      require(r[name].is_boolean(), std::string("result/") + name + " is neither true nor false");
  if (r.contains("response")) require(r["response"].is_string(), "result/response is no text");
  if (r.contains("duration"))
    require(r["duration"].is_string() && isDuration(r["duration"]), "result/duration is none");
  if (r.contains("extensions")) extensions(r["extensions"], "result/extensions");
}

void context(const json& statement) {
  const json& c = statement["context"];
  onlyNames(c,
            {"registration", "instructor", "team", "contextActivities", "revision", "platform",
             "language", "statement", "extensions"},
            "context");
  if (c.contains("registration"))
    require(isUuidText(c["registration"]), "context/registration is no UUID");
  if (c.contains("instructor")) agent(c["instructor"], "context/instructor");
  const std::string type = statement["object"].value("objectType", "Activity");
  for (const char* name : {"revision", "platform"})
    if (c.contains(name))
      require(type == "Activity" && c[name].is_string(),
              std::string("context/") + name + " goes with an Activity only");
  if (c.contains("extensions")) extensions(c["extensions"], "context/extensions");
  if (!c.contains("contextActivities")) return;
  onlyNames(c["contextActivities"], {"parent", "grouping", "category", "other"},
            "context/contextActivities");
  for (const auto& [name, list] : c["contextActivities"].items()) {
    require(list.is_array(), "context/contextActivities/" + name + " is no list");
    for (const json& one : list) activity(one, "context/contextActivities/" + name);
  }
}

void statementRules(const json& s) {
  onlyNames(s,
            {"id", "actor", "verb", "object", "result", "context", "timestamp", "stored",
             "authority", "version", "attachments"},
            "statement");
  noNulls(s, "statement");
  for (const char* name : {"actor", "verb", "object"})
    require(s.contains(name), std::string(name) + " is missing");
  if (s.contains("id")) require(isUuidText(s["id"]), "id is no UUID");
  agent(s["actor"], "actor");
  onlyNames(s["verb"], {"id", "display"}, "verb");
  require(s["verb"].contains("id") && isIriText(s["verb"]["id"]), "verb has no IRI");
  if (s["verb"].contains("display")) languageMap(s["verb"]["display"], "verb/display");
  object(s);
  if (s.contains("result")) result(s["result"]);
  if (s.contains("context")) context(s);
  if (s.contains("timestamp"))
    require(s["timestamp"].is_string() && isTimestamp(s["timestamp"]), "timestamp is none");
  if (s.contains("version"))
    require(s["version"].is_string() && matches(s["version"], "1\\.0\\.[0-9]+"),
            "version is not 1.0.x");
}

}  // namespace

bool isIri(const std::string& text) {
  return matches(text, "[A-Za-z][A-Za-z0-9+.-]*:[^ <>\"{}|\\\\^`\\x00-\\x1f]+");
}

bool isTimestamp(const std::string& text) {
  return matches(text,
                 "[0-9]{4}-(0[1-9]|1[0-2])-(0[1-9]|[12][0-9]|3[01])T([01][0-9]|2[0-3]):[0-5][0-9]:("
                 "[0-5][0-9]|60)(\\.[0-9]+)?(Z|[+-]([01][0-9]|2[0-3]):[0-5][0-9])") &&
         !text.ends_with("-00:00");
}

bool isDuration(const std::string& text) {
  return matches(text,
                 "P(?!$)([0-9]+Y)?([0-9]+M)?([0-9]+D)?(T(?=[0-9])([0-9]+H)?([0-9]+M)?([0-9]+(\\.[0-"
                 "9]+)?S)?)?|P[0-9]+W");
}

std::string whyNoStatement(const json& statement) {
  try {
    statementRules(statement);
    return "";
  } catch (const Broken& e) {
    return e.what();
  } catch (const json::exception& e) {
    return e.what();
  }
}

}  // namespace palpa::link_test
