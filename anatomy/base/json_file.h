#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace palpa {

/// A JSON file whose every access names file and field when something is wrong. All members throw
/// UsageError: a damaged file is a set-up mistake, reported in one line.
class JsonFile {
 public:
  JsonFile() = default;
  /// `remedy`: what to do about a field that is refused.
  explicit JsonFile(const std::filesystem::path& file, std::string remedy = kCorrect);
  JsonFile(nlohmann::json json, std::string name, std::string remedy = kCorrect)
      : json_(std::move(json)), name_(std::move(name)), remedy_(std::move(remedy)) {}
  /// The same from the file's text, as a recording holds it; messages name `name` instead.
  static JsonFile ofText(std::string_view text, std::string name, std::string remedy = kCorrect);

  /// `path`: fields separated by '/', e.g. "skin/m_per_mm". A number may also be an object
  /// {"value": 2, "unit": "1/mm", "source": "...", "range": [1, 4]}; the range is then checked.
  double number(const std::string& path) const;
  double number(const std::string& path, double low, double high) const;  ///< checks the range, too
  int integer(const std::string& path, int low, int high) const;
  std::string text(const std::string& path) const;
  std::array<double, 3> triple(const std::string& path) const;    ///< a list of three numbers
  std::vector<double> numbers(const std::string& path) const;     ///< a list, of any length
  std::vector<std::string> texts(const std::string& path) const;  ///< a list, of any length
  bool flag(const std::string& path) const;
  bool flag(const std::string& path, bool otherwise) const;  ///< `otherwise` where it is missing
  bool has(const std::string& path) const { return find(path) != nullptr; }
  /// The entries of a list, each a file of its own that is named for the list; none where the field
  /// is missing.
  std::vector<JsonFile> entries(const std::string& list) const;

  const nlohmann::json& json() const { return json_; }
  const std::string& name() const { return name_; }
  const std::string& remedy() const { return remedy_; }
  /// Field "version" is 1 to `newest`: files of later programs are refused.
  int needVersion(int newest) const;
  [[noreturn]] void refuse(const std::string& path, const std::string& what) const;

 private:
  static constexpr const char* kCorrect = "Correct the file";

  const nlohmann::json* find(const std::string& path) const;
  const nlohmann::json& need(const std::string& path) const;
  const nlohmann::json& list(const std::string& path, const char* of) const;

  nlohmann::json json_;
  std::string name_, remedy_ = kCorrect;
};

}  // namespace palpa
