#include "anatomy/base/json_file.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/whole_file.h"

namespace palpa {
namespace {

constexpr std::uintmax_t kLargestFile = 4 << 20;
// Nested deeper is damage, and would exhaust the stack of who writes it out.
constexpr int kDeepestFile = 32;

void refuseLarge(std::uintmax_t size, const std::string& name) {
  if (size > kLargestFile)
    throw UsageError("is too large for a settings file", name, "Check the name");
}

std::string textOf(const std::filesystem::path& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error)
    throw UsageError("cannot be read (" + whyUnread(error) + ")", file.string(), "Check the name");
  refuseLarge(size, file.string());
  std::optional<std::string> text = readWhole(file);
  if (!text) throw UsageError("cannot be read", file.string(), "Check its permissions");
  return *std::move(text);
}

}  // namespace

JsonFile::JsonFile(const std::filesystem::path& file, std::string remedy)
    : JsonFile(ofText(textOf(file), file.string(), std::move(remedy))) {}

JsonFile JsonFile::ofText(std::string_view text, std::string name, std::string remedy) {
  refuseLarge(text.size(), name);
  try {
    nlohmann::json json = parseJson(
        text, kDeepestFile, [&] { throw UsageError("is nested too deep", name, "Restore it"); });
    return {std::move(json), std::move(name), std::move(remedy)};
  } catch (const nlohmann::json::exception& e) {
    throw UsageError("is not valid JSON (" + whyNoJson(text, e) + ")", name,
                     "Restore it or correct it there");
  }
}

void JsonFile::refuse(const std::string& path, const std::string& what) const {
  throw UsageError(
      "field \"" + path.substr(std::min(path.size(), path.find_first_not_of('/'))) + "\" " + what,
      name_, remedy_);
}

const nlohmann::json* JsonFile::find(const std::string& path) const {
  const nlohmann::json* here = &json_;
  std::stringstream parts(path);
  for (std::string part; std::getline(parts, part, '/');) {
    if (part.empty()) continue;  // "/columns" is "columns": of an entry itself
    if (!here->is_object() || !here->contains(part)) return nullptr;
    here = &(*here)[part];
  }
  return here;
}

const nlohmann::json& JsonFile::need(const std::string& path) const {
  const nlohmann::json* found = find(path);
  if (!found) refuse(path, "is missing");
  return *found;
}

std::vector<JsonFile> JsonFile::entries(const std::string& list) const {
  const nlohmann::json* items = find(list);
  if (!items) return {};
  if (!items->is_array()) refuse(list, "must be a list");
  std::vector<JsonFile> each;
  for (const nlohmann::json& item : *items)
    each.emplace_back(item, name_ + ", \"" + list + "\", entry " + std::to_string(each.size() + 1),
                      remedy_);
  return each;
}

double JsonFile::number(const std::string& path) const {
  const nlohmann::json* value = &need(path);
  const nlohmann::json* range = nullptr;
  if (value->is_object()) {
    range = value->contains("range") ? &(*value)["range"] : nullptr;
    value = value->contains("value") ? &(*value)["value"] : value;
  }
  if (!value->is_number()) refuse(path, "is not a number");
  const double x = value->get<double>();
  if (!std::isfinite(x)) refuse(path, "is not finite");
  if (range) {
    if (!range->is_array() || range->size() != 2 || !(*range)[0].is_number() ||
        !(*range)[1].is_number())
      refuse(path, "has a range that is not [low, high]");
    if (x < (*range)[0].get<double>() || x > (*range)[1].get<double>())
      refuse(path, "is " + value->dump() + ", outside its range " + range->dump());
  }
  return x;
}

double JsonFile::number(const std::string& path, double low, double high) const {
  const double x = number(path);
  if (x < low || x > high) {
    std::ostringstream text;
    text << "is " << x << ", outside " << low << " to " << high;
    refuse(path, text.str());
  }
  return x;
}

int JsonFile::integer(const std::string& path, int low, int high) const {
  const double x = number(path, low, high);
  if (x != std::floor(x)) refuse(path, "is not a whole number");
  return static_cast<int>(x);
}

int JsonFile::needVersion(int newest) const {
  const int version = integer("version", 1, 1'000'000);
  if (version > newest)
    refuse("version", "is newer than this program knows (" + std::to_string(newest) + ")");
  return version;
}

std::string JsonFile::text(const std::string& path) const {
  const nlohmann::json& value = need(path);
  if (!value.is_string()) refuse(path, "is not a text");
  return value.get<std::string>();
}

std::array<double, 3> JsonFile::triple(const std::string& path) const {
  const nlohmann::json& value = need(path);
  if (!value.is_array() || value.size() != 3) refuse(path, "is not a list of three numbers");
  std::array<double, 3> xyz{};
  for (std::size_t i = 0; i < xyz.size(); ++i) {
    if (!value[i].is_number()) refuse(path, "is not a list of three numbers");
    xyz[i] = value[i].get<double>();
  }
  for (const double x : xyz)
    if (!std::isfinite(x)) refuse(path, "is not finite");
  return xyz;
}

const nlohmann::json& JsonFile::list(const std::string& path, const char* of) const {
  const nlohmann::json& value = need(path);
  if (!value.is_array()) refuse(path, std::string("is not a list of ") + of);
  return value;
}

std::vector<double> JsonFile::numbers(const std::string& path) const {
  std::vector<double> all;
  for (const nlohmann::json& value : list(path, "numbers")) {
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      refuse(path, "is not a list of numbers");
    all.push_back(value.get<double>());
  }
  return all;
}

std::vector<std::string> JsonFile::texts(const std::string& path) const {
  std::vector<std::string> all;
  for (const nlohmann::json& value : list(path, "texts")) {
    if (!value.is_string()) refuse(path, "is not a list of texts");
    all.push_back(value.get<std::string>());
  }
  return all;
}

bool JsonFile::flag(const std::string& path) const {
  const nlohmann::json& value = need(path);
  if (!value.is_boolean()) refuse(path, "must be true or false");
  return value.get<bool>();
}

bool JsonFile::flag(const std::string& path, bool otherwise) const {
  return has(path) ? flag(path) : otherwise;
}

}  // namespace palpa
