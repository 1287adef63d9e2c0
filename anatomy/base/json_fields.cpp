#include "anatomy/base/json_fields.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/json_text.h"
#include "anatomy/base/nearest_word.h"

namespace palpa {
namespace {

constexpr std::size_t kLargestText = 4u << 20;
constexpr int kDeepest = 16;
constexpr std::size_t kLongestText = 2000;
constexpr const char* kSchema = "$schema";  // by which an editor finds what a field means

}  // namespace

std::string printable(const std::string& key) {
  const std::string quoted =
      nlohmann::json(key).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  return quoted.substr(1, std::min<std::size_t>(quoted.size() - 2, 60));
}

nlohmann::json parseJson(const std::string& text, const std::string& file) {
  if (text.size() > kLargestText) throw UsageError("is larger than 4 MiB", file, "Check the name");
  try {
    return parseJson(text, kDeepest,
                     [&] { throw UsageError("is nested too deep", file, "Correct the file"); });
  } catch (const nlohmann::json::exception& e) {
    throw UsageError("is not valid JSON (" + whyNoJson(text, e) + ")", file,
                     "Correct the file at the place named");
  }
}

JsonFields::JsonFields(const nlohmann::json& object, std::string file, std::string path)
    : object_(object), file_(std::move(file)), path_(std::move(path)) {
  if (!object_.is_object())
    throw UsageError((path_.empty() ? std::string("the file") : "field \"" + path_ + "\"") +
                         " is not an object { }",
                     file_, "Correct the file");
}

void JsonFields::refuse(const std::string& field, const std::string& what) const {
  throw UsageError("field \"" + pathOf(field) + "\" " + what, file_, "Correct the file");
}

const nlohmann::json* JsonFields::find(const std::string& field) {
  asked_.insert(field);
  const auto found = object_.find(field);
  return found == object_.end() ? nullptr : &*found;
}

const nlohmann::json& JsonFields::need(const std::string& field) {
  const nlohmann::json* found = find(field);
  if (!found) refuse(field, "is missing" + meantBy(field));
  return *found;
}

std::string JsonFields::meantBy(const std::string& field) const {
  std::vector<std::string> others;
  for (const auto& [key, ignored] : object_.items())
    if (!asked_.count(key)) others.push_back(printable(key));
  const std::optional<std::string> other = nearestWord(field, others);
  return other ? "; did you mean it by \"" + *other + "\"?" : "";
}

std::string JsonFields::text(const std::string& field) {
  const nlohmann::json& value = need(field);
  if (!value.is_string()) refuse(field, "is not a text");
  std::string words = value.get<std::string>();
  if (words.empty() || words.size() > kLongestText)
    refuse(field, "is empty or longer than 2000 letters");
  for (const char c : words)
    if (static_cast<unsigned char>(c) < 32)
      refuse(field, "holds a line break or another control character");
  return words;
}

std::string JsonFields::textOr(const std::string& field, const std::string& otherwise) {
  return find(field) ? text(field) : otherwise;
}

double JsonFields::numberOr(const std::string& field, double otherwise, double least, double most) {
  const nlohmann::json* value = find(field);
  if (!value) return otherwise;
  if (!value->is_number()) refuse(field, "is not a number");
  const double x = value->get<double>();
  if (!(x >= least && x <= most))
    refuse(field, "is " + value->dump() + ", not between " + nlohmann::json(least).dump() +
                      " and " + nlohmann::json(most).dump());
  return x;
}

bool JsonFields::flagOr(const std::string& field, bool otherwise) {
  const nlohmann::json* value = find(field);
  if (!value) return otherwise;
  if (!value->is_boolean()) refuse(field, "is neither true nor false");
  return value->get<bool>();
}

std::array<double, 3> JsonFields::triple(const std::string& field, double most) {
  const nlohmann::json& value = need(field);
  if (!value.is_array() || value.size() != 3) refuse(field, "is not three numbers");
  std::array<double, 3> xyz{};
  for (std::size_t i = 0; i < xyz.size(); ++i) {
    if (!value[i].is_number()) refuse(field, "is not three numbers");
    xyz[i] = value[i].get<double>();
  }
  for (const double x : xyz)
    if (!(std::abs(x) <= most))  // nor not a number
      refuse(field, "has a number larger than " + nlohmann::json(most).dump());
  return xyz;
}

void JsonFields::done() const {
  const std::vector<std::string> known(asked_.begin(), asked_.end());
  for (const auto& [key, value] : object_.items()) {
    if (asked_.count(key) || (path_.empty() && key == kSchema && value.is_string())) continue;
    std::string all;
    for (const std::string& name : known) all += (all.empty() ? "" : ", ") + name;
    throw UsageError("field \"" + pathOf(printable(key)) + "\" is unknown" + didYouMean(key, known),
                     file_, "Known here: " + all);
  }
}

}  // namespace palpa
