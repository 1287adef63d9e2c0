#include "damages.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/support/counts.h"

namespace palpa::schemas {
namespace {

using nlohmann::json;
using Pointer = json::json_pointer;

/// A whole number as one: valijson takes no 6.0 for an integer, readers and editors do.
json numeric(double x) {
  return x == std::floor(x) && std::abs(x) < 1e15 ? json(static_cast<std::int64_t>(x)) : json(x);
}

void collect(const json& schema, const std::string& field, Limits* limits) {
  if (schema.is_array())
    for (const json& part : schema) collect(part, field, limits);
  if (!schema.is_object()) return;
  for (const char* limit : {"minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum"})
    if (schema.contains(limit) && schema.at(limit).is_number())
      (*limits)[field].insert(schema.at(limit).get<double>());
  for (const auto& [key, part] : schema.items()) {
    if (key != "properties") {
      collect(part, field, limits);
      continue;
    }
    for (const auto& [name, property] : part.items())
      collect(property, name == "value" ? field : name, limits);
  }
}

class Damager {
 public:
  Damager(const json& document, const Limits& limits, const Judge& judge)
      : document_(document), limits_(limits), judge_(judge) {}

  void visit(const Pointer& place, const std::string& field) {
    const json& value = document_.at(place);
    otherTypes(place, value);
    if (value.is_number()) atLimits(place, field);
    if (value.is_object()) ofObject(place, value, field);
    if (value.is_array()) ofList(place, value, field);
  }

 private:
  void replace(const Pointer& place, const std::string& how, const json& wrong) const {
    json changed = document_;
    changed.at(place) = wrong;
    judge_(place.to_string() + " " + how, changed);
  }

  void otherTypes(const Pointer& place, const json& value) const {
    static const json kOthers[] = {"text", 7, true, nullptr, json::array(), json::object()};
    for (const json& other : kOthers)
      if (other != value) replace(place, "as " + other.dump(), other);
  }

  void atLimits(const Pointer& place, const std::string& field) const {
    const auto found = limits_.find(field);
    if (found == limits_.end()) return;
    for (const double limit : found->second)
      for (const double x : {limit, limit - 1, limit + 1, limit - 1e-3 * std::abs(limit),
                             limit + 1e-3 * std::abs(limit)})
        replace(place, "at " + numeric(x).dump(), numeric(x));
  }

  void ofObject(const Pointer& place, const json& value, const std::string& field) {
    json more = value;
    more["no_such_field"] = 1;
    replace(place, "with an unknown field", more);
    for (const auto& [key, ignored] : value.items()) {
      json less = value;
      less.erase(key);
      replace(place, "without " + key, less);
      visit(place / key, key == "value" ? field : key);
    }
  }

  void ofList(const Pointer& place, const json& value, const std::string& field) {
    if (!value.empty() && !value.back().is_object()) {
      json longer = value, shorter = value;
      longer.push_back(value.back());
      shorter.erase(shorter.size() - 1);
      replace(place, "longer", longer);
      replace(place, "shorter", shorter);
    }
    for (std::size_t i = 0; i < value.size(); ++i)
      if (i < test::counted<std::size_t>(1, 2) || i + 1 == value.size()) visit(place / i, field);
  }

  const json& document_;
  const Limits& limits_;
  const Judge& judge_;
};

}  // namespace

namespace {

/// About its middle; empty where no letters differ there.
std::string swapped(std::string word) {
  for (std::size_t i = std::max<std::size_t>(1, word.size() / 2); i < word.size(); ++i)
    if (word[i] != word[i - 1]) {
      std::swap(word[i], word[i - 1]);
      return word;
    }
  return "";
}

std::vector<std::string> misspellingsOf(const std::string& word) {
  const std::size_t middle = word.size() / 2;
  std::string less = word, more = word;
  less.erase(middle, 1);
  more.insert(middle, 1, word[middle]);
  std::vector<std::string> all{swapped(word), less, more};
  std::erase(all, "");
  return all;
}

void collectKeys(const json& part, const Pointer& at, std::vector<Pointer>* keys) {
  if (part.is_object())
    for (const auto& [key, inner] : part.items()) {
      keys->push_back(at / key);
      collectKeys(inner, at / key, keys);
    }
  if (part.is_array())
    for (std::size_t i = 0; i < part.size(); ++i) collectKeys(part[i], at / i, keys);
}

}  // namespace

void eachMisspelling(const json& document,
                     const std::function<void(const Mistyped& key, const json& document)>& judge) {
  std::vector<Pointer> keys;
  collectKeys(document, Pointer(), &keys);
  for (const Pointer& key : keys)
    for (const std::string& wrong : misspellingsOf(key.back())) {
      json changed = document;
      json& object = changed.at(key.parent_pointer());
      if (object.contains(wrong)) continue;
      object[wrong] = object.at(key.back());
      object.erase(key.back());
      judge({key.to_string(), key.back(), wrong}, changed);
    }
}

Limits limitsIn(const json& schema) {
  Limits limits;
  collect(schema, "", &limits);
  return limits;
}

json withoutOwnRanges(json document) {
  if (document.is_object() && document.contains("value")) document.erase("range");
  if (document.is_structured())
    for (json& part : document) part = withoutOwnRanges(json(part));
  return document;
}

void eachDamage(const json& document, const Limits& limits, const Judge& judge) {
  Damager(document, limits, judge).visit(Pointer(), "");
}

}  // namespace palpa::schemas
