#include "apps/study/questionnaire.h"

#include <set>

#include "anatomy/base/enum_names.h"
#include "anatomy/base/file_schema.h"
#include "anatomy/base/json_file.h"
#include "apps/study/protocol.h"

namespace palpa::study {
namespace {

constexpr int kFewestPoints = 2, kMostPoints = 11;
constexpr std::size_t kLongestAnswer = 2000;
const EnumNames<ItemKind> kItemKinds{"likert", "text"};

Item itemIn(const JsonFile& file) {
  Item item;
  item.id = needName(file, "id");
  item.question = file.text("question");
  item.may_be_left = file.flag("may_be_left", false);
  item.kind = kItemKinds.in(file, "kind", "it must be likert or text");
  if (item.kind == ItemKind::text) return item;
  item.points = file.integer("points", kFewestPoints, kMostPoints);
  item.low = file.text("low");
  item.high = file.text("high");
  return item;
}

}  // namespace

Questionnaire readQuestionnaire(const std::filesystem::path& path) {
  const JsonFile file(path);
  needKind(file, "questionnaire", 1);
  Questionnaire q{needName(file, "id"), file.text("title"), file.text("source"), {}};
  std::set<std::string> ids;
  for (const JsonFile& entry : file.entries("items")) {
    q.items.push_back(itemIn(entry));
    if (!ids.insert(q.items.back().id).second)
      entry.refuse("id", "is \"" + q.items.back().id + "\", which another item has, too");
  }
  if (q.items.empty()) file.refuse("items", "must be a list of at least one item");
  return q;
}

std::string whyNoAnswer(const Item& item, const std::string& answer) {
  if (answer.empty()) return item.may_be_left ? "" : "an answer is needed";
  if (answer.size() > kLongestAnswer)
    return "the answer is longer than " + std::to_string(kLongestAnswer) + " characters";
  if (item.kind == ItemKind::text) return "";
  const bool number =
      answer.size() <= 2 && answer.find_first_not_of("0123456789") == std::string::npos;
  if (number && std::stoi(answer) >= 1 && std::stoi(answer) <= item.points) return "";
  return "the answer is a whole number from 1 to " + std::to_string(item.points);
}

}  // namespace palpa::study
