#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace palpa::study {

/// How a question is answered.
enum class ItemKind { likert, text };

/// A question to the trainee: a whole number on a scale whose ends have words (Likert), or free
/// text.
struct Item {
  std::string id;
  ItemKind kind = ItemKind::likert;
  std::string question;
  std::string low, high;     ///< words at the scale's ends
  int points = 5;            ///< of the scale, from 1
  bool may_be_left = false;  ///< an empty answer is one
};

struct Questionnaire {
  std::string id, title, source;
  std::vector<Item> items;
};

/// Throws UsageError naming file and field.
Questionnaire readQuestionnaire(const std::filesystem::path& file);

/// Why this cannot be the item's answer; empty: it can.
std::string whyNoAnswer(const Item& item, const std::string& answer);

}  // namespace palpa::study
