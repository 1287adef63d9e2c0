#include "apps/assess/competence/form.h"

#include <algorithm>
#include <optional>
#include <set>
#include <sstream>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "apps/assess/metrics/metric_table.h"

namespace palpa::competence {
namespace {

using Json = nlohmann::json;

/// A form's file; every access names file and field when something is wrong.
class FormFile {
 public:
  FormFile(const std::string& text, std::string where) : where_(std::move(where)) {
    json_ = parsedOrDiscarded(text);
    if (json_.is_discarded() || !json_.is_object())
      throw UsageError("is not JSON", where_, "Restore it from the program's assets");
    if (const double version = number(json_, "version", 1, 1e9); version != 1)
      refuse("version", "is of a newer program");
  }
  const Json& json() const { return json_; }

  [[noreturn]] void refuse(const std::string& field, const std::string& what) const {
    throw UsageError(what, where_ + ", " + field,
                     "The shipped forms in assets/checklists show how it is written");
  }
  std::string text(const Json& at, const std::string& field) const {
    if (!at.is_object() || !at.contains(field) || !at.at(field).is_string() ||
        at.at(field).get<std::string>().empty())
      refuse(field, "must be a text");
    return at.at(field).get<std::string>();
  }
  double number(const Json& at, const std::string& field, double low, double high) const {
    if (!at.is_object() || !at.contains(field) || !at.at(field).is_number())
      refuse(field, "must be a number");
    const double value = at.at(field).get<double>();
    if (!(value >= low && value <= high)) refuse(field, "is out of range");
    return value;
  }
  const Json& list(const Json& at, const std::string& field) const {
    if (!at.is_object() || !at.contains(field) || !at.at(field).is_array() || at.at(field).empty())
      refuse(field, "must be a list with something in it");
    return at.at(field);
  }
  std::string freshId(const Json& at, std::set<std::string>* taken) const {
    const std::string id = text(at, "id");
    if (id.find_first_of(", \"\t\n") != std::string::npos)
      refuse("id", "\"" + id + "\" must have neither spaces nor commas: it is typed in");
    if (!taken->insert(id).second) refuse("id", "\"" + id + "\" is there twice");
    return id;
  }

 private:
  std::string where_;
  Json json_;
};

Rule ruleIn(const FormFile& file, const Json& at) {
  Rule rule;
  rule.metric = file.text(at, "metric");
  if (!metrics::metricNamed(rule.metric))
    file.refuse("metric", "\"" + rule.metric +
                              "\" is no figure of a trial (palpa records metrics lists them)");
  const bool applies = at.contains("applies") && at.at("applies") == true;
  if (!applies && !at.contains("at_least") && !at.contains("at_most"))
    file.refuse("metric", "\"" + rule.metric + "\" needs \"at_least\", \"at_most\" or \"applies\"");
  if (at.contains("at_least")) rule.at_least = file.number(at, "at_least", -1e9, 1e9);
  if (at.contains("at_most")) rule.at_most = file.number(at, "at_most", -1e9, 1e9);
  return rule;
}

Item itemIn(const FormFile& file, const Json& at, std::set<std::string>* taken) {
  Item item;
  item.id = file.freshId(at, taken);
  item.text = file.text(at, "text");
  const std::string weight = file.text(at, "weight"), by = file.text(at, "judged_by");
  if (weight != "major" && weight != "minor")
    file.refuse("weight", "of \"" + item.id + "\" must be major or minor");
  item.major = weight == "major";
  if (by != "simulator" && by != "rater")
    file.refuse("judged_by", "of \"" + item.id + "\" must be simulator or rater");
  if (by == "rater") return item;
  for (const Json& rule : file.list(at, "rules")) item.rules.push_back(ruleIn(file, rule));
  if (!at.contains("without")) return item;
  const std::string without = file.text(at, "without");
  if (without != "not done" && without != "did not arise")
    file.refuse("without", "of \"" + item.id + "\" must be \"not done\" or \"did not arise\"");
  item.may_not_arise = without == "did not arise";
  return item;
}

Level levelIn(const FormFile& file, const Json& levels, const char* name) {
  if (!levels.contains(name)) file.refuse(std::string("levels/") + name, "is missing");
  return {static_cast<int>(file.number(levels.at(name), "major", 0, 1000)),
          static_cast<int>(file.number(levels.at(name), "minor", 0, 1000))};
}

}  // namespace

Checklist parseChecklist(const std::string& text, const std::string& where) {
  const FormFile file(text, where);
  const Json& json = file.json();
  Checklist list;
  list.id = file.text(json, "id");
  list.title = file.text(json, "title");
  list.source = file.text(json, "source");
  for (const Json& standard : file.list(json, "standards"))
    list.standards.push_back(file.number(standard, "share_pct", 1, 100) / 100);
  if (!json.contains("levels")) file.refuse("levels", "is missing");
  list.competent = levelIn(file, json.at("levels"), "competent");
  list.borderline = levelIn(file, json.at("levels"), "borderline");
  list.levels_source = file.text(json.at("levels"), "source");
  std::set<std::string> taken;
  for (const Json& item : file.list(json, "items"))
    list.items.push_back(itemIn(file, item, &taken));
  for (const Json& critical : file.list(json, "critical"))
    list.critical.push_back(
        {file.freshId(critical, &taken), file.text(critical, "text"), ruleIn(file, critical)});
  return list;
}

GlobalRating parseGlobalRating(const std::string& text, const std::string& where) {
  const FormFile file(text, where);
  const Json& json = file.json();
  GlobalRating rating;
  rating.id = file.text(json, "id");
  rating.title = file.text(json, "title");
  rating.source = file.text(json, "source");
  if (!json.contains("pass")) file.refuse("pass", "is missing");
  rating.mean_at_least = file.number(json.at("pass"), "mean_at_least", 1, kBestGrade);
  rating.none_below = static_cast<int>(file.number(json.at("pass"), "none_below", 1, kBestGrade));
  std::set<std::string> taken;
  for (const Json& item : file.list(json, "items"))
    rating.items.push_back({file.freshId(item, &taken), file.text(item, "text"),
                            file.text(item, "1"), file.text(item, "3"), file.text(item, "5")});
  return rating;
}

namespace {

std::string trimmed(const std::string& text) {
  const std::size_t from = text.find_first_not_of(" \t\r\""), to = text.find_last_not_of(" \t\r\"");
  return from == std::string::npos ? "" : text.substr(from, to - from + 1);
}

template <class Items>
bool has(const Items& items, const std::string& id) {
  return std::any_of(items.begin(), items.end(), [&](const auto& item) { return item.id == id; });
}

std::optional<int> doneIn(const std::string& word) {
  for (const int answer : {kDone, kNotDone, kDidNotArise})
    if (word == answerWords(answer)) return answer;
  return std::nullopt;
}

std::optional<int> gradeIn(const std::string& word) {
  if (word.size() == 1 && word[0] >= '1' && word[0] <= '0' + kBestGrade) return word[0] - '0';
  return std::nullopt;
}

}  // namespace

const char* answerWords(int answer) {
  return answer == kDone ? "done" : answer == kNotDone ? "not done" : "did not arise";
}

FormAnswers parseAnswers(const std::string& text, const std::string& where,
                         const Checklist& checklist, const GlobalRating* global) {
  FormAnswers answers;
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    line = trimmed(line.substr(0, line.find('#')));
    if (line.empty() || line == "item,value") continue;
    const auto refuse = [&](const std::string& what) {
      throw UsageError(what, where + ", line " + std::to_string(number),
                       "A line is item,value: done, not done or did not arise; a grade is 1 to 5");
    };
    const std::size_t comma = line.find(',');
    if (comma == std::string::npos) refuse("has no comma");
    const std::string id = trimmed(line.substr(0, comma)), word = trimmed(line.substr(comma + 1));
    if (word.empty()) continue;  // left blank on the paper
    const bool of_list = has(checklist.items, id);
    if (!of_list && !(global && has(global->items, id)))
      refuse("names \"" + id + "\", which the form does not have");
    const std::optional<int> value = of_list ? doneIn(word) : gradeIn(word);
    if (!value) refuse("\"" + word + "\" is no answer to \"" + id + "\"");
    if (!(of_list ? answers.checklist : answers.global).emplace(id, *value).second)
      refuse("answers \"" + id + "\" again");
  }
  return answers;
}

}  // namespace palpa::competence
