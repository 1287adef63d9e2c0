#include <algorithm>
#include <optional>
#include <sstream>

#include "anatomy/geometry/error.h"
#include "apps/assess/competence/form.h"

namespace palpa::competence {
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
