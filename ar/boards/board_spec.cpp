#include "ar/boards/board_spec.h"

#include <charconv>
#include <sstream>

#include "anatomy/base/error.h"
#include "ar/boards/april_grid.h"
#include "ar/boards/chessboard.h"
#include "ar/boards/tag_grid.h"

namespace palpa::ar {
namespace {

[[noreturn]] void refuse(const std::string& spec, const std::string& what) {
  throw UsageError(what, "board '" + spec + "'",
                   "Known are tags:COLUMNSxROWS:SIZE:GAP[:FIRST_ID] (tags:6x4:0.030:0.0075), "
                   "aprilgrid:COLUMNSxROWS:SIZE:GAP/SIZE[:BORDER_BITS] (aprilgrid:6x6:0.088:0.3), "
                   "chessboard:COLUMNSxROWS:SQUARE[:HALF_WINDOW_PX] counting inner corners "
                   "(chessboard:9x6:0.025), "
                   "charuco:COLUMNSxROWS:SQUARE:MARKER[:DICTIONARY] counting squares "
                   "(charuco:7x5:0.030:0.022:DICT_5X5_100), tag36h11:SIZE (tag36h11:0.05), and "
                   "files FILE.json (ours) and FILE.yaml (Kalibr's); lengths in metres.");
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

TagGridSpec aprilGridSpec(const std::vector<std::string>& parts, const std::string& spec) {
  const cv::Size size = counts(parts[1], spec);
  TagGridSpec grid{size.width, size.height, length(parts[2], spec), 0, 0, 2, true};
  grid.spacing = grid.tag_size * parse<double>(parts[3], spec);
  if (parts.size() == 5) grid.border_bits = parse<int>(parts[4], spec);
  validate(grid, "board '" + spec + "'");
  return grid;
}

CharucoSpec charucoSpec(const std::vector<std::string>& parts, const std::string& spec) {
  const cv::Size size = counts(parts[1], spec);
  CharucoSpec charuco{size.width, size.height, length(parts[2], spec), length(parts[3], spec)};
  if (parts.size() == 5) charuco.dictionary = parts[4];
  validate(charuco, "board '" + spec + "'");
  return charuco;
}

bool isFile(const std::string& spec) {
  return spec.ends_with(".json") || spec.ends_with(".yaml") || spec.ends_with(".yml");
}

}  // namespace

BoardSpec parseBoardSpec(const std::string& word) {
  if (isFile(word)) return readTagGrid(word);
  const std::vector<std::string> parts = split(word, ':');
  const std::string kind = parts.empty() ? "" : parts[0];
  const bool four_or_five = parts.size() == 4 || parts.size() == 5, three = parts.size() == 3;
  if (kind == "tags" && four_or_five) return gridSpec(parts, word);
  if (kind == "aprilgrid" && four_or_five) return aprilGridSpec(parts, word);
  if (kind == "charuco" && four_or_five) return charucoSpec(parts, word);
  if (kind == "chessboard" && (three || parts.size() == 4))
    return ChessboardSpec{counts(parts[1], word), length(parts[2], word),
                          three ? 0 : parse<int>(parts[3], word)};
  if (kind == "tag36h11" && parts.size() == 2) return SingleTagSpec{length(parts[1], word)};
  for (const char* known : {"tags", "aprilgrid", "charuco", "chessboard", "tag36h11"})
    if (kind == known) refuse(word, "has too few or too many parts");
  refuse(word, "unknown kind '" + kind + "'");
}

namespace {

struct Maker {
  double decimate;

  std::unique_ptr<Board> operator()(const TagGridSpec& spec) const {
    if (spec.corner_squares) return std::make_unique<AprilGridBoard>(spec);
    return std::make_unique<TagGridBoard>(spec, decimate);
  }
  std::unique_ptr<Board> operator()(const ChessboardSpec& spec) const {
    return std::make_unique<Chessboard>(spec.inner_corners, spec.square, spec.half_window_px);
  }
  std::unique_ptr<Board> operator()(const SingleTagSpec& spec) const {
    return std::make_unique<SingleTagBoard>(spec.tag_size, decimate);
  }
  std::unique_ptr<Board> operator()(const CharucoSpec& spec) const {
    return std::make_unique<CharucoBoard>(spec);
  }
};

struct SheetMaker {
  Sheet operator()(const TagGridSpec& spec) const { return sheetOf(spec); }
  Sheet operator()(const ChessboardSpec& spec) const {
    return chessboardSheet(spec.inner_corners, spec.square);
  }
  Sheet operator()(const SingleTagSpec& spec) const {
    return sheetOf(TagGridSpec{1, 1, spec.tag_size, spec.tag_size / 4, 0});
  }
  Sheet operator()(const CharucoSpec& spec) const { return sheetOf(spec); }
};

}  // namespace

std::unique_ptr<Board> makeBoard(const TagGridSpec& spec, double decimate) {
  return Maker{decimate}(spec);
}

std::unique_ptr<Board> makeBoard(const std::string& spec, double decimate) {
  return std::visit(Maker{decimate}, parseBoardSpec(spec));
}

Sheet sheetOf(const std::string& spec) { return std::visit(SheetMaker{}, parseBoardSpec(spec)); }

cv::Mat drawBoard(const std::string& spec, double px_per_m) {
  return pictureOf(sheetOf(spec), px_per_m);
}

}  // namespace palpa::ar
