#include <charconv>
#include <map>
#include <sstream>

#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>

#include "anatomy/base/error.h"
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

/// Our board files are JSON; OpenCV's reader is used because this library links no other.
namespace palpa::ar {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& file, const std::string& what) {
  throw Error(what, file.string(), "Compare it with assets/boards/table.json.");
}

cv::FileNode field(const cv::FileNode& root, const char* name, const fs::path& file) {
  const cv::FileNode node = root[name];
  if (node.empty()) refuse(file, std::string("field '") + name + "' is missing");
  return node;
}

double number(const cv::FileNode& root, const char* name, const fs::path& file) {
  const cv::FileNode node = field(root, name, file);
  if (!node.isInt() && !node.isReal())
    refuse(file, std::string("field '") + name + "' must be a number");
  return static_cast<double>(node);
}

int wholeNumber(const cv::FileNode& root, const char* name, const fs::path& file) {
  const cv::FileNode node = field(root, name, file);
  if (!node.isInt()) refuse(file, std::string("field '") + name + "' must be a whole number");
  return static_cast<int>(node);
}

std::string word(const cv::FileNode& root, const char* name, const fs::path& file) {
  const cv::FileNode node = field(root, name, file);
  if (!node.isString()) refuse(file, std::string("field '") + name + "' must be a word");
  return static_cast<std::string>(node);
}

int wholeNumberOr(int otherwise, const cv::FileNode& root, const char* name, const fs::path& file) {
  return root[name].empty() ? otherwise : wholeNumber(root, name, file);
}

std::string textOf(const fs::path& file) {
  std::error_code code;
  if (!fs::is_regular_file(file, code)) refuse(file, "no such file");
  if (fs::file_size(file, code) > (1U << 20) || code) refuse(file, "too large for a board");
  std::optional<std::string> text = readWhole(file);
  if (!text || text->find('\0') != std::string::npos) refuse(file, "is not text");
  return std::move(*text);
}

bool isYaml(const fs::path& file) {
  return file.extension() == ".yaml" || file.extension() == ".yml";
}

TagGridSpec parseJson(const std::string& text, const fs::path& file) {
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  if (start == std::string::npos || text[start] != '{') refuse(file, "is not a JSON object");
  const cv::FileStorage storage(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
  const cv::FileNode root = storage.root();
  if (!root.isMap()) refuse(file, "is not a JSON object");
  if (wholeNumber(root, "version", file) != 1) refuse(file, "field 'version' is not 1");
  if (word(root, "family", file) != "tag36h11") refuse(file, "field 'family' must be tag36h11");
  return {wholeNumber(root, "columns", file),
          wholeNumber(root, "rows", file),
          number(root, "tag_size_m", file),
          number(root, "spacing_m", file),
          wholeNumber(root, "first_id", file),
          wholeNumberOr(1, root, "border_bits", file),
          wholeNumberOr(0, root, "corner_squares", file) != 0};
}

}  // namespace

TagGridSpec readTagGrid(const fs::path& file) {
  const std::string text = textOf(file);
  if (isYaml(file)) return parseKalibrTarget(text, file.string());
  const auto level = cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  try {
    const TagGridSpec spec = parseJson(text, file);
    cv::utils::logging::setLogLevel(level);
    validate(spec, file.string());
    return spec;
  } catch (const Error&) {
    cv::utils::logging::setLogLevel(level);
    throw;
  } catch (const std::exception&) {
    cv::utils::logging::setLogLevel(level);
    refuse(file, "is damaged or cut short");
  }
}

}  // namespace palpa::ar
