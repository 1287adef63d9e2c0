#include <fstream>
#include <iterator>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>

#include "anatomy/geometry/error.h"
#include "ar/board.h"
#include "ar/kalibr_target.h"

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

std::string slurp(const fs::path& file) {
  std::error_code code;
  if (!fs::is_regular_file(file, code)) refuse(file, "no such file");
  if (fs::file_size(file, code) > (1U << 20) || code) refuse(file, "too large for a board");
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in || text.find('\0') != std::string::npos) refuse(file, "is not text");
  return text;
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
  const std::string text = slurp(file);
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
