#include <algorithm>
#include <map>
#include <string>

#include "anatomy/base/error.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/sha256.h"
#include "anatomy/base/whole_file.h"
#include "apps/console/routes.h"
#include "apps/record/store/record_store.h"
#include "apps/station/assets.h"

/// What an educator marks on a tablet while somebody is examined, and the verdict that simulator
/// and rater come to together. Nothing is judged here: `palpa report` does that.
namespace palpa::console {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kMostTrials = 1000, kBestGrade = 5;

json formIn(const char* file) { return JsonFile(station::assetFile(file)).json(); }

/// What a page asks of an item: no rule, no source.
json askedOf(const json& form, std::initializer_list<const char*> fields) {
  json items = json::array();
  for (const json& item : form.at("items")) {
    if (item.value("judged_by", "rater") != "rater") continue;
    json asked;
    for (const char* field : fields)
      if (item.contains(field)) asked[field] = item[field];
    items.push_back(asked);
  }
  return {{"id", form.at("id")}, {"title", form.at("title")}, {"items", items}};
}

json forms() {
  return {
      {"checklist", askedOf(formIn("checklists/subclavian.json"), {"id", "text", "weight"})},
      {"global", askedOf(formIn("checklists/global_rating.json"), {"id", "text", "1", "3", "5"})}};
}

/// By item, as a sheet has it. Throws UsageError for what the forms do not ask.
std::map<std::string, std::string> valuesIn(const json& body) {
  const json asked = forms(), said = body.value("values", json::object());
  if (!said.is_object()) throw UsageError("are no marks", "values", "Load the page again");
  const auto has = [&](const char* form, const std::string& id) {
    const json& items = asked[form]["items"];
    return std::any_of(items.begin(), items.end(), [&](const json& i) { return i["id"] == id; });
  };
  std::map<std::string, std::string> values;
  for (const auto& [id, value] : said.items()) {
    const bool done = value == "done" || value == "not done" || value == "did not arise",
               grade = value.is_number_integer() && value >= 1 && value <= kBestGrade;
    if (has("checklist", id) && done)
      values[id] = value.get<std::string>();
    else if (has("global", id) && grade)
      values[id] = std::to_string(value.get<int>());
    else
      throw UsageError("is no item of the forms, or its mark is none", id.substr(0, 64),
                       "Load the page again");
  }
  return values;
}

struct RatedTrial {
  std::string id;  ///< of the session
  fs::path folder;
  std::string number;

  fs::path sheet() const { return folder / ("rating-" + number + ".csv"); }
  std::string exam() const { return "exam-" + number + ".html"; }
  std::string certificate() const { return "certificate-" + number + ".pdf"; }
};

RatedTrial trialOf(Console& c, const httplib::Request& request) {
  const std::string number = request.matches[2];
  if (number.size() > 4 || std::stoi(number) < 1 || std::stoi(number) > kMostTrials)
    throw UsageError("is no number of a trial", number, "Choose one from the list");
  return {request.matches[1], c.sessions.folder(request.matches[1]), number};
}

constexpr char kRater[] = "# rater: ";

/// The sheet as `palpa report trial --answers` reads it; who filled it in stands in a remark.
void keep(const RatedTrial& trial, const json& body) {
  const std::string rater = body.value("rater", json()).is_string() ? body["rater"] : json("");
  if (const std::string why = record::whyNoPseudonym(rater); !why.empty())
    throw UsageError(why, "the rater's pseudonym", "Use letters, digits, - and _");
  std::string sheet = kRater + rater + "\nitem,value\n";
  for (const auto& [id, value] : valuesIn(body)) sheet += id + ',' + value + '\n';
  writeWhole(trial.sheet(), sheet);
}

json kept(const RatedTrial& trial) {
  const std::string sheet = readWhole(trial.sheet()).value_or("");
  json told{{"rater", ""}, {"values", json::object()}};
  std::size_t at = 0;
  while (at < sheet.size()) {
    const std::size_t end = std::min(sheet.find('\n', at), sheet.size());
    const std::string line = sheet.substr(at, end - at);
    at = end + 1;
    const std::size_t comma = line.find(',');
    if (line.rfind(kRater, 0) == 0)
      told["rater"] = line.substr(sizeof(kRater) - 1);
    else if (comma != std::string::npos && line != "item,value") {
      const std::string value = line.substr(comma + 1);
      told["values"][line.substr(0, comma)] =
          value.size() == 1 ? json(value[0] - '0') : json(value);
    }
  }
  return told;
}

/// The page of the verdict, made by the command that judges; anew for every other sheet.
json verdictOf(Console& c, const RatedTrial& trial, const std::string& what) {
  const fs::path results = c.sessions.shown(trial.id);
  const bool rated = fs::exists(trial.sheet());
  const std::string sheet = readWhole(trial.sheet()).value_or(""),
                    name = what == "certificate" ? trial.certificate() : trial.exam();
  JobRequest request{what + " " + trial.id + " " + trial.number + " " + sha256(sheet),
                     what == "certificate" ? "Certificate" : "Verdict on a trial",
                     {"report", what == "certificate" ? "certificate" : "trial", results.string(),
                      "--trial", trial.number, "--out", (results / name).string()},
                     "",
                     {}};
  if (rated)
    request.arguments.insert(request.arguments.end(), {"--answers", trial.sheet().string(),
                                                       "--rater", kept(trial)["rater"]});
  json told = pageOf(c.jobs.ask(std::move(request)));
  told["page"] = told["state"] == "done" ? "/api/sessions/" + trial.id + "/file/" + name : "";
  return told;
}

}  // namespace

void addRatingRoutes(WebServer& server, Console& c) {
  server.Get("/api/forms",
             [](const httplib::Request&, httplib::Response& r) { answer(r, forms()); });
  constexpr const char* kRating = R"(/api/sessions/([A-Za-z0-9_-]{1,64})/ratings/([0-9]{1,4}))";
  server.Get(kRating, [&c](const httplib::Request& q, httplib::Response& r) {
    answer(r, kept(trialOf(c, q)));
  });
  server.Post(kRating, [&c](const httplib::Request& q, httplib::Response& r) {
    const RatedTrial trial = trialOf(c, q);
    keep(trial, bodyOf(q));
    answer(r, kept(trial));
  });
  for (const char* what : {"verdict", "certificate"})
    server.Get(std::string(kRating) + "/" + what,
               [&c, what](const httplib::Request& q, httplib::Response& r) {
                 answer(r, verdictOf(c, trialOf(c, q), what));
               });
}

}  // namespace palpa::console
