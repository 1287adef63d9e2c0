#include "ar/kalibr_target.h"

#include <charconv>
#include <map>
#include <sstream>

#include "anatomy/geometry/error.h"

namespace palpa::ar {
namespace {

using Fields = std::map<std::string, std::string>;

[[noreturn]] void refuseTarget(const std::string& where, const std::string& what) {
  throw Error(what, where,
              "A target that works: target_type: 'aprilgrid', tagCols: 6, tagRows: 6, "
              "tagSize: 0.088, tagSpacing: 0.3, each on a line of its own.");
}

/// Without blanks round it, and without a pair of quotes.
std::string bare(const std::string& text) {
  const std::size_t from = text.find_first_not_of(" \t\r");
  if (from == std::string::npos) return "";
  const std::string word = text.substr(from, text.find_last_not_of(" \t\r") - from + 1);
  const bool quoted = word.size() >= 2 && (word.front() == '\'' || word.front() == '"') &&
                      word.back() == word.front();
  return quoted ? word.substr(1, word.size() - 2) : word;
}

Fields fieldsOf(const std::string& text, const std::string& where) {
  Fields fields;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    line = line.substr(0, line.find('#'));
    if (bare(line).empty() || bare(line) == "---" || line.front() == '%') continue;
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) refuseTarget(where, "'" + bare(line) + "' is not 'key: value'");
    const std::string key = bare(line.substr(0, colon));
    if (!fields.emplace(key, bare(line.substr(colon + 1))).second)
      refuseTarget(where, "key '" + key + "' comes twice");
  }
  return fields;
}

const std::string& valueOf(const Fields& fields, const std::string& key, const std::string& where) {
  const auto found = fields.find(key);
  if (found == fields.end()) refuseTarget(where, "key '" + key + "' is missing");
  return found->second;
}

template <typename T>
T numberOf(const Fields& fields, const std::string& key, const std::string& where) {
  const std::string& text = valueOf(fields, key, where);
  T value{};
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size())
    refuseTarget(where, "key '" + key + "': '" + text + "' is not such a number");
  return value;
}

}  // namespace

TagGridSpec parseKalibrTarget(const std::string& text, const std::string& where) {
  const Fields fields = fieldsOf(text, where);
  const std::string& type = valueOf(fields, "target_type", where);
  if (type != "aprilgrid") refuseTarget(where, "target_type '" + type + "' is not 'aprilgrid'");
  for (const auto& [key, value] : fields)
    if (key != "target_type" && key != "tagCols" && key != "tagRows" && key != "tagSize" &&
        key != "tagSpacing")
      refuseTarget(where, "unknown key '" + key + "'");
  const double size = numberOf<double>(fields, "tagSize", where);
  const double ratio = numberOf<double>(fields, "tagSpacing", where);
  const TagGridSpec spec{numberOf<int>(fields, "tagCols", where),
                         numberOf<int>(fields, "tagRows", where),
                         size,
                         ratio * size,
                         0,
                         2,
                         true};
  validate(spec, where);
  return spec;
}

}  // namespace palpa::ar
