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

/// What one rater marks of one trial.
struct RatedTrial {
  std::string id;  ///< of the session
  fs::path folder;
  std::string number, rater;

  std::string stem() const { return number + '-' + rater; }
  fs::path sheet() const { return folder / ("rating-" + stem() + ".csv"); }
};

/// What the commands make of a sheet.
struct RatedPage {
  const char* what;                   ///< "trial", as `palpa report` has it
  const char *title, *stem, *ending;  ///< of its file
};
constexpr RatedPage kPages[] = {{"trial", "Verdict on a trial", "exam-", ".html"},
                                {"certificate", "Certificate", "certificate-", ".pdf"}};

RatedTrial trialOf(Console& c, const httplib::Request& request) {
  const std::string number = request.matches[2], rater = request.matches[3];
  if (std::stoi(number) < 1 || std::stoi(number) > kMostTrials)
    throw UsageError("is no number of a trial", number, "Choose one from the list");
  if (const std::string why = record::whyNoPseudonym(rater); !why.empty())
    throw UsageError(why, "the rater's pseudonym", "Use letters, digits, - and _");
  return {request.matches[1], c.sessions.folder(request.matches[1]), number, rater};
}

/// The sheet as `palpa report trial --answers` reads it. What was made of the one before goes: a
/// pass must not outlive the marks that earned it.
void keep(Console& c, const RatedTrial& trial, const json& body) {
  std::string sheet = "# rater: " + trial.rater + "\nitem,value\n";
  for (const auto& [id, value] : valuesIn(body)) sheet += id + ',' + value + '\n';
  if (readWhole(trial.sheet()).value_or("") == sheet) return;
  writeWhole(trial.sheet(), sheet);
  std::error_code none;
  for (const RatedPage& page : kPages)
    fs::remove(c.sessions.results(trial.id) / (page.stem + trial.stem() + page.ending), none);
}

json kept(const RatedTrial& trial) {
  const std::string sheet = readWhole(trial.sheet()).value_or("");
  json values = json::object();
  std::size_t end = 0;
  for (std::size_t at = 0; at < sheet.size(); at = end + 1) {
    end = std::min(sheet.find('\n', at), sheet.size());
    const std::string line = sheet.substr(at, end - at);
    const std::size_t comma = line.find(',');
    if (comma == std::string::npos || line == "item,value") continue;
    const std::string value = line.substr(comma + 1);
    values[line.substr(0, comma)] = value.size() == 1 ? json(value[0] - '0') : json(value);
  }
  return {{"rater", trial.rater}, {"values", values}};
}

/// Into the records, too, where the trial is in them; else whoever needs it there enters it later.
void enterIntoRecords(Console& c, const RatedTrial& trial, const fs::path& results,
                      const std::string& sheet_sha256) {
  if (c.sessions.one(trial.id).value("trainee", "").empty()) return;
  c.jobs.ask({"enter " + trial.id + ' ' + trial.stem() + ' ' + sheet_sha256,
              "Rating into the records",
              {"rate", "enter", "--session", results.string(), "--trial", trial.number, "--rater",
               trial.rater, "--answers", trial.sheet().string(), "--records", c.place.records},
              "",
              {}});
}

/// Made by the command that judges; anew once the sheet is another.
json madeOf(Console& c, const RatedTrial& trial, const RatedPage& page) {
  const fs::path results = c.sessions.shown(trial.id);
  const std::string sheet = sha256(readWhole(trial.sheet()).value_or("")),
                    name = page.stem + trial.stem() + page.ending;
  JobRequest request{std::string(page.what) + ' ' + trial.id + ' ' + trial.stem() + ' ' + sheet,
                     page.title,
                     {"report", page.what, results.string(), "--trial", trial.number, "--out",
                      (results / name).string()},
                     (results / name).string(),
                     {}};
  if (fs::exists(trial.sheet())) {
    request.arguments.insert(request.arguments.end(), {"--answers", trial.sheet().string()});
    enterIntoRecords(c, trial, results, sheet);
  }
  json told = pageOf(c.jobs.ask(std::move(request)));
  told["page"] = told["state"] == "done" ? "/api/sessions/" + trial.id + "/file/" + name : "";
  return told;
}

}  // namespace

void addRatingRoutes(WebServer& server, Console& c) {
  server.Get("/api/forms",
             [](const httplib::Request&, httplib::Response& r) { answer(r, forms()); });
  const std::string rating =
      R"(/api/sessions/([A-Za-z0-9_-]{1,64})/ratings/([0-9]{1,4})/([A-Za-z0-9_-]{1,64}))";
  server.Get(rating, [&c](const httplib::Request& q, httplib::Response& r) {
    answer(r, kept(trialOf(c, q)));
  });
  server.Post(rating, [&c](const httplib::Request& q, httplib::Response& r) {
    const RatedTrial trial = trialOf(c, q);
    keep(c, trial, bodyOf(q));
    answer(r, kept(trial));
  });
  for (const RatedPage& page : kPages)
    server.Get(rating + "/" + page.what,
               [&c, &page](const httplib::Request& q, httplib::Response& r) {
                 answer(r, madeOf(c, trialOf(c, q), page));
               });
}

}  // namespace palpa::console
