#include <charconv>
#include <map>
#include <sstream>

#include "anatomy/base/error.h"
#include "anatomy/base/file_schema.h"
#include "anatomy/base/json_file.h"
#include "anatomy/base/whole_file.h"
#include "ar/boards/board.h"
#include "ar/boards/board_spec.h"

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

namespace palpa::ar {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestBoard = 1U << 20;  // bytes
constexpr int kMostTags = 587;                      // of the family
constexpr const char* kCompare = "Compare it with assets/boards/table.json";

std::string textOf(const fs::path& file) {
  const auto refuse = [&](const char* what) { throw Error(what, file.string(), kCompare); };
  std::error_code code;
  if (!fs::is_regular_file(file, code)) refuse("no such file");
  if (fs::file_size(file, code) > kLargestBoard || code) refuse("too large for a board");
  std::optional<std::string> text = readWhole(file);
  if (!text || text->find('\0') != std::string::npos) refuse("is not text");
  return std::move(*text);
}

bool isYaml(const fs::path& file) {
  return file.extension() == ".yaml" || file.extension() == ".yml";
}

bool hasCornerSquares(const JsonFile& file) {
  constexpr const char* kField = "corner_squares";
  if (!file.has(kField)) return false;
  return file.json().at(kField).is_boolean() ? file.flag(kField)
                                             : file.integer(kField, -kMostTags, kMostTags) != 0;
}

TagGridSpec gridIn(const JsonFile& file) {
  constexpr int kMostBits = 1000;  // what is too many is said with all that is wrong with a board
  needKind(file, "board", 1);
  if (file.text("family") != "tag36h11") file.refuse("family", "must be tag36h11");
  return {file.integer("columns", 1, kMostTags),
          file.integer("rows", 1, kMostTags),
          file.number("tag_size_m"),
          file.number("spacing_m"),
          file.integer("first_id", 0, kMostTags - 1),
          file.has("border_bits") ? file.integer("border_bits", 0, kMostBits) : 1,
          hasCornerSquares(file)};
}

}  // namespace

TagGridSpec readTagGrid(const fs::path& file) {
  const std::string text = textOf(file);
  if (isYaml(file)) return parseKalibrTarget(text, file.string());
  const TagGridSpec spec = gridIn(JsonFile::ofText(text, file.string(), kCompare));
  validate(spec, file.string());
  return spec;
}

}  // namespace palpa::ar
