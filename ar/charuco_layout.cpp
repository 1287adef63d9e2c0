#include "ar/charuco_layout.h"

#include <array>
#include <utility>

#include "anatomy/geometry/error.h"

namespace palpa::ar {
namespace {

constexpr std::array<const char*, 21> kDictionaries = {  // in the order of OpenCV's enumeration
    "DICT_4X4_50",         "DICT_4X4_100",       "DICT_4X4_250",       "DICT_4X4_1000",
    "DICT_5X5_50",         "DICT_5X5_100",       "DICT_5X5_250",       "DICT_5X5_1000",
    "DICT_6X6_50",         "DICT_6X6_100",       "DICT_6X6_250",       "DICT_6X6_1000",
    "DICT_7X7_50",         "DICT_7X7_100",       "DICT_7X7_250",       "DICT_7X7_1000",
    "DICT_ARUCO_ORIGINAL", "DICT_APRILTAG_16h5", "DICT_APRILTAG_25h9", "DICT_APRILTAG_36h10",
    "DICT_APRILTAG_36h11"};

void requireCharuco(bool good, const std::string& what, const std::string& where) {
  if (!good)
    throw UsageError(what, where,
                     "A board that works: 7 x 5 squares of 0.030 m, markers of 0.022 m, "
                     "DICT_5X5_100.");
}

cv::Ptr<cv::aruco::Dictionary> dictionaryNamed(const std::string& name, const std::string& where) {
  for (std::size_t i = 0; i < kDictionaries.size(); ++i)
    if (name == kDictionaries[i]) return cv::aruco::getPredefinedDictionary(int(i));
  throw UsageError("unknown dictionary '" + name + "'", where,
                   "Known are OpenCV's DICT_4X4_50 to DICT_7X7_1000 (4X4 to 7X7; 50, 100, 250, "
                   "1000), DICT_ARUCO_ORIGINAL and DICT_APRILTAG_16h5, 25h9, 36h10, 36h11.");
}

}  // namespace

void validate(const CharucoSpec& spec, const std::string& where) {
  const auto count = [](int n) { return n >= 3 && n <= 100; };
  requireCharuco(count(spec.columns) && count(spec.rows), "needs 3 to 100 squares each way", where);
  requireCharuco(spec.square >= 0.0005 && spec.square <= 2, "the square must be 0.0005 to 2 m",
                 where);
  requireCharuco(spec.marker >= 0.3 * spec.square && spec.marker <= 0.9 * spec.square,
                 "the marker must be 0.3 to 0.9 of the square", where);
  const int markers = spec.columns * spec.rows / 2;
  requireCharuco(dictionaryNamed(spec.dictionary, where)->bytesList.rows >= markers,
                 "the dictionary has fewer than " + std::to_string(markers) + " markers", where);
}

cv::Ptr<cv::aruco::CharucoBoard> charucoLayout(const CharucoSpec& spec) {
  validate(spec, "ChArUco board");
  return cv::aruco::CharucoBoard::create(spec.columns, spec.rows, float(spec.square),
                                         float(spec.marker),
                                         dictionaryNamed(spec.dictionary, "ChArUco board"));
}

std::vector<cv::Point2d> charucoMarkersBefore46(const CharucoSpec& spec) {
  std::vector<cv::Point2d> middles;
  for (int row = 0; row < spec.rows; ++row)
    for (int col = 0; col < spec.columns; ++col)
      if ((spec.rows - 1 - row + col) % 2 == 1)
        middles.emplace_back((col + 0.5) * spec.square, (row + 0.5) * spec.square);
  return middles;
}

}  // namespace palpa::ar
