#include <charconv>
#include <sstream>

#include "anatomy/geometry/error.h"
#include "ar/board.h"
#include "ar/chessboard.h"
#include "ar/tag_grid.h"

namespace palpa::ar {
namespace {

[[noreturn]] void refuse(const std::string& spec, const std::string& what) {
  throw UsageError(what, "board '" + spec + "'",
                   "Known are tags:COLUMNSxROWS:SIZE:GAP[:FIRST_ID] (tags:6x4:0.030:0.0075), "
                   "chessboard:COLUMNSxROWS:SQUARE counting inner corners (chessboard:9x6:0.025) "
                   "and tag36h11:SIZE (tag36h11:0.05); lengths in metres.");
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
  if (!text.empty() && text.back() == separator) parts.emplace_back();
  return parts;
}

/// The whole text as a number, independent of the locale.
template <typename T>
T parse(const std::string& text, const std::string& spec) {
  T value{};
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size())
    refuse(spec, "'" + text + "' is not a number");
  return value;
}

double length(const std::string& text, const std::string& spec) {
  const double value = parse<double>(text, spec);
  if (!(value > 0 && value <= 2)) refuse(spec, "'" + text + "' must be more than 0 and up to 2 m");
  return value;
}

cv::Size counts(const std::string& text, const std::string& spec) {
  const std::vector<std::string> parts = split(text, 'x');
  if (parts.size() != 2) refuse(spec, "'" + text + "' must be COLUMNSxROWS");
  return {parse<int>(parts[0], spec), parse<int>(parts[1], spec)};
}

TagGridSpec gridSpec(const std::vector<std::string>& parts, const std::string& spec) {
  const cv::Size size = counts(parts[1], spec);
  TagGridSpec grid{size.width, size.height, length(parts[2], spec), length(parts[3], spec), 0};
  if (parts.size() == 5) grid.first_id = parse<int>(parts[4], spec);
  validate(grid, "board '" + spec + "'");
  return grid;
}

}  // namespace

std::unique_ptr<Board> makeBoard(const TagGridSpec& spec, double decimate) {
  return std::make_unique<TagGridBoard>(spec, decimate);
}

std::unique_ptr<Board> makeBoard(const std::string& spec, double decimate) {
  const std::vector<std::string> parts = split(spec, ':');
  const std::string kind = parts.empty() ? "" : parts[0];
  if (kind == "tags" && (parts.size() == 4 || parts.size() == 5))
    return makeBoard(gridSpec(parts, spec), decimate);
  if (kind == "chessboard" && parts.size() == 3)
    return std::make_unique<Chessboard>(counts(parts[1], spec), length(parts[2], spec));
  if (kind == "tag36h11" && parts.size() == 2)
    return std::make_unique<SingleTagBoard>(length(parts[1], spec), decimate);
  refuse(spec, kind == "tags" || kind == "chessboard" || kind == "tag36h11"
                   ? "has too few or too many parts"
                   : "unknown kind '" + kind + "'");
}

}  // namespace palpa::ar
