#include "apps/assess/competence/form.h"

#include <algorithm>
#include <optional>
#include <set>
#include <sstream>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/file_schema.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/json_text.h"
#include "apps/assess/metrics/metric_table.h"

namespace palpa::competence {
namespace {

constexpr const char* kRemedy = "The shipped forms in assets/checklists show how it is written";

JsonFile formIn(const std::string& text, const std::string& where, const char* kind) {
  JsonFile file = JsonFile::ofText(text, where, kRemedy);
  needKind(file, kind, 1);
  return file;
}

std::string textIn(const JsonFile& file, const std::string& field) {
  std::string text = file.text(field);
  if (text.empty()) file.refuse(field, "is empty");
  return text;
}

std::vector<JsonFile> someIn(const JsonFile& file, const std::string& list) {
  std::vector<JsonFile> entries = file.entries(list);
  if (entries.empty()) file.refuse(list, "must be a list that is not empty");
  return entries;
}

std::string freshId(const JsonFile& file, std::set<std::string>* taken) {
  std::string id = textIn(file, "id");
  if (id.find_first_of(", \"\t\n") != std::string::npos)
    file.refuse("id", "is \"" + id + "\"; it is typed in: no spaces, no commas");
  if (!taken->insert(id).second) file.refuse("id", "is \"" + id + "\", which occurs twice");
  return id;
}

Rule ruleIn(const JsonFile& file) {
  Rule rule;
  rule.metric = textIn(file, "metric");
  if (!metrics::metricNamed(rule.metric))
    file.refuse("metric",
                "is \"" + rule.metric +
                    "\", which is not a figure of a trial (palpa records metrics lists them)");
  const nlohmann::json& json = file.json();
  const bool applies = json.contains("applies") && json.at("applies") == true;
  if (!applies && !file.has("at_least") && !file.has("at_most"))
    file.refuse("metric", "is \"" + rule.metric +
                              "\", which needs \"at_least\", \"at_most\" or \"applies\" beside it");
  if (file.has("at_least")) rule.at_least = file.number("at_least", -1e9, 1e9);
  if (file.has("at_most")) rule.at_most = file.number("at_most", -1e9, 1e9);
  return rule;
}

/// Which of two words a field holds: whether it is the first.
bool isFirst(const JsonFile& file, const std::string& field, const std::string& first,
             const std::string& second) {
  const std::string word = textIn(file, field);
  if (word != first && word != second)
    file.refuse(field, "is \"" + word + "\"; it must be \"" + first + "\" or \"" + second + "\"");
  return word == first;
}

ChecklistItem itemIn(const JsonFile& file, std::set<std::string>* taken) {
  ChecklistItem item;
  item.id = freshId(file, taken);
  item.text = textIn(file, "text");
  item.major = isFirst(file, "weight", "major", "minor");
  if (isFirst(file, "judged_by", "rater", "simulator")) return item;
  for (const JsonFile& rule : someIn(file, "rules")) item.rules.push_back(ruleIn(rule));
  item.may_not_arise = file.has("without") && isFirst(file, "without", "did not arise", "not done");
  return item;
}

Level levelIn(const JsonFile& file, const std::string& level) {
  return {static_cast<int>(file.number(level + "/major", 0, 1000)),
          static_cast<int>(file.number(level + "/minor", 0, 1000))};
}

}  // namespace

Checklist parseChecklist(const std::string& text, const std::string& where) {
  const JsonFile file = formIn(text, where, "checklist");
  Checklist list;
  list.id = textIn(file, "id");
  list.title = textIn(file, "title");
  list.source = textIn(file, "source");
  for (const JsonFile& standard : someIn(file, "standards"))
    list.standards.push_back(standard.number("share_pct", 1, 100) / 100);
  list.competent = levelIn(file, "levels/competent");
  list.borderline = levelIn(file, "levels/borderline");
  list.levels_source = textIn(file, "levels/source");
  std::set<std::string> taken;
  for (const JsonFile& item : someIn(file, "items")) list.items.push_back(itemIn(item, &taken));
  for (const JsonFile& critical : someIn(file, "critical"))
    list.critical.push_back(
        {freshId(critical, &taken), textIn(critical, "text"), ruleIn(critical)});
  return list;
}

GlobalRating parseGlobalRating(const std::string& text, const std::string& where) {
  const JsonFile file = formIn(text, where, "global_rating");
  GlobalRating rating;
  rating.id = textIn(file, "id");
  rating.title = textIn(file, "title");
  rating.source = textIn(file, "source");
  rating.mean_at_least = file.number("pass/mean_at_least", 1, kBestGrade);
  rating.none_below = static_cast<int>(file.number("pass/none_below", 1, kBestGrade));
  std::set<std::string> taken;
  for (const JsonFile& item : someIn(file, "items"))
    rating.items.push_back({freshId(item, &taken), textIn(item, "text"), textIn(item, "1"),
                            textIn(item, "3"), textIn(item, "5")});
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
    if (!value) refuse("\"" + word + "\" is not an answer to \"" + id + "\"");
    if (!(of_list ? answers.checklist : answers.global).emplace(id, *value).second)
      refuse("answers \"" + id + "\" again");
  }
  return answers;
}

}  // namespace palpa::competence
