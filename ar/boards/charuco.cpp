#include "ar/boards/charuco.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "anatomy/base/error.h"
#include "ar/boards/gray_picture.h"
#include "ar/boards/opencv_aruco.h"
#include "ar/boards/sheet.h"

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

aruco::Dictionary dictionaryNamed(const std::string& name, const std::string& where) {
  for (std::size_t i = 0; i < kDictionaries.size(); ++i)
    if (name == kDictionaries[i]) return aruco::predefined(int(i));
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
  requireCharuco(dictionaryNamed(spec.dictionary, where).bytesList.rows >= markers,
                 "the dictionary has fewer than " + std::to_string(markers) + " markers", where);
}

aruco::CharucoPattern charucoLayout(const CharucoSpec& spec) {
  validate(spec, "ChArUco board");
  return aruco::makeBoard({spec.columns, spec.rows}, float(spec.square), float(spec.marker),
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

struct CharucoBoard::Layout {
  aruco::CharucoPattern board;
  std::vector<cv::Point2d> middles, middles_before_46;  ///< of the markers, metres, OpenCV's frame
};

namespace {

using aruco::Markers;

/// Each of the board's markers once; none of an id that is seen at two places.
Markers once(const Markers& all, int count) {
  Markers markers;
  for (std::size_t i = 0; i < all.ids.size(); ++i)
    if (all.ids[i] < count && std::count(all.ids.begin(), all.ids.end(), all.ids[i]) == 1) {
      markers.corners.push_back(all.corners[i]);
      markers.ids.push_back(all.ids[i]);
    }
  return markers;
}

/// From the board's plane, as one of its markers shows it, to the picture.
cv::Matx33d markerToPicture(const std::vector<cv::Point3f>& marker,
                            const std::vector<cv::Point2f>& picture) {
  cv::Point2f plane[4];
  for (std::size_t i = 0; i < 4; ++i) plane[i] = {marker[i].x, marker[i].y};
  return cv::getPerspectiveTransform(plane, picture.data());
}

/// Moves a corner, as predicted by the markers, to the saddle point; false where there is none with
/// the colours of this board round it. OpenCV 4.6 has refined its corners already, but leaves them
/// half a pixel off both ways.
bool refineCharuco(const cv::Mat& gray, const aruco::CharucoPattern& board, const Markers& markers,
                   int id, Eigen::Vector2d* pixel) {
  const std::size_t corner = std::size_t(id);
  const std::size_t nearest = std::size_t(board.nearest[corner][0]);
  const auto seen = std::find(markers.ids.begin(), markers.ids.end(), board.ids[nearest]);
  if (seen == markers.ids.end()) return false;
  const std::vector<cv::Point2f>& marker = markers.corners[std::size_t(seen - markers.ids.begin())];
  const double side = double(board.opencv->getMarkerLength());
  const double margin = (double(board.opencv->getSquareLength()) - side) / 2;
  if (!refineSaddle(gray, margin / side * outlineHeight(marker), pixel)) return false;
  const cv::Matx33d H = markerToPicture(board.markers[nearest], marker);
  const Eigen::Vector2d p(board.corners[corner].x, board.corners[corner].y);
  const int columns = board.opencv->getChessboardSize().width - 1;
  const double sign = (id / columns + id % columns) % 2 == 0 ? 1 : -1;
  return isCrossing(gray, *pixel, stepInPicture(H, p, {sign * margin / 2, 0}),
                    stepInPicture(H, p, {0, margin / 2}));
}

cv::Point2d middleOf(const std::vector<cv::Point2f>& corners) {
  return cv::Point2d(corners[0] + corners[1] + corners[2] + corners[3]) / 4;
}

/// How many pairs of markers stand to each other as a layout has them: one predicts the other's
/// middle to within half their distance.
int agreeingPairs(const Markers& markers, double side, const std::vector<cv::Point2d>& middles) {
  const float h = float(side) / 2;
  const std::vector<cv::Point3f> marker = {{-h, -h, 0}, {h, -h, 0}, {h, h, 0}, {-h, h, 0}};
  int count = 0;
  for (std::size_t i = 0; i < markers.ids.size(); ++i) {
    const cv::Matx33d H = markerToPicture(marker, markers.corners[i]);
    const cv::Point2d here = middleOf(markers.corners[i]);
    for (std::size_t j = 0; j < markers.ids.size(); ++j) {
      const cv::Point2d step =
          middles[std::size_t(markers.ids[j])] - middles[std::size_t(markers.ids[i])];
      const Eigen::Vector2d predicted = stepInPicture(H, {0, 0}, {step.x, step.y});
      const cv::Point2d seen = middleOf(markers.corners[j]) - here;
      const double distance = cv::norm(seen);
      count += cv::norm(cv::Point2d(predicted.x(), predicted.y()) - seen) < 0.5 * distance;
    }
  }
  return count;
}

/// Points that span a plane: no line goes through all of them.
bool spread(const std::vector<BoardPoint>& points) {
  if (points.size() < 4) return false;
  Eigen::Matrix2Xd p(2, Eigen::Index(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    p.col(Eigen::Index(i)) = points[i].p_W.head<2>() - points[0].p_W.head<2>();
  p.colwise() -= p.rowwise().mean().eval();
  const Eigen::Matrix2d scatter = p * p.transpose();
  return scatter.determinant() > 1e-6 * scatter.trace() * scatter.trace();
}

}  // namespace

CharucoBoard::CharucoBoard(const CharucoSpec& spec)
    : spec_(spec), layout_(std::make_unique<Layout>()) {
  layout_->board = charucoLayout(spec);
  for (const auto& marker : layout_->board.markers) {
    const cv::Point3d middle = cv::Point3d(marker[0] + marker[2]) / 2;
    layout_->middles.emplace_back(middle.x, middle.y);
  }
  layout_->middles_before_46 = charucoMarkersBefore46(spec);
}

CharucoBoard::~CharucoBoard() = default;

std::vector<BoardPoint> CharucoBoard::detect(const cv::Mat& image) const {
  const cv::Mat gray = grayPicture(image);
  if (std::min(gray.cols, gray.rows) < 32) return {};
  const Markers all = aruco::detectMarkers(gray, layout_->board.dictionary);
  const Markers markers = once(all, int(layout_->board.ids.size()));
  if (markers.ids.size() < 2) return {};
  if (agreeingPairs(markers, spec_.marker, layout_->middles) <
      agreeingPairs(markers, spec_.marker, layout_->middles_before_46))
    return {};
  std::vector<cv::Point2f> pixels;
  std::vector<int> ids;
  aruco::interpolateCorners(gray, layout_->board, markers, &pixels, &ids);
  std::vector<BoardPoint> points;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    Eigen::Vector2d pixel(pixels[i].x, pixels[i].y);
    if (!refineCharuco(gray, layout_->board, markers, ids[i], &pixel)) continue;
    const cv::Point3f& corner = layout_->board.corners[std::size_t(ids[i])];
    points.push_back({charucoPointW(spec_, corner), pixel});
  }
  if (!spread(points)) points.clear();
  return points;
}

std::string CharucoBoard::describe() const {
  std::ostringstream text;
  text << "ChArUco board of " << spec_.columns << " x " << spec_.rows << " squares of "
       << spec_.square * 1000 << " mm with markers of " << spec_.marker * 1000 << " mm, "
       << spec_.dictionary;
  return text.str();
}

namespace {

void drawSquares(const CharucoSpec& spec, Sheet* sheet) {
  const double left = -spec.columns * spec.square / 2, top = spec.rows * spec.square / 2;
  for (int row = 0; row < spec.rows; ++row)
    for (int col = 0; col < spec.columns; ++col)
      if ((row + col) % 2 == 0)
        sheet->black.push_back(
            {left + col * spec.square, top - (row + 1) * spec.square, spec.square, spec.square});
}

/// `left`, `top`: in W.
void drawMarker(const cv::Mat& bits, double left, double top, double side, Sheet* sheet) {
  const int n = bits.rows + 2;  // a black border of one cell
  const double cell = side / n;
  for (int row = 0; row < n; ++row)
    for (int col = 0; col < n; ++col) {
      const bool border = row == 0 || col == 0 || row == n - 1 || col == n - 1;
      if (border || bits.at<uchar>(row - 1, col - 1) == 0)
        sheet->black.push_back({left + col * cell, top - (row + 1) * cell, cell, cell});
    }
}

}  // namespace

Sheet sheetOf(const CharucoSpec& spec) {
  const aruco::CharucoPattern layout = charucoLayout(spec);
  const aruco::Dictionary& dictionary = layout.dictionary;
  const Eigen::Vector2d size = Eigen::Vector2d(spec.columns + 2, spec.rows + 2) * spec.square;
  Sheet sheet{"ChArUco board", size, spec.marker / (dictionary.markerSize + 2), {}};
  drawSquares(spec, &sheet);
  for (std::size_t i = 0; i < layout.ids.size(); ++i) {
    const Vec3 upper_left = charucoPointW(spec, layout.markers[i][0]);
    const cv::Mat bits = aruco::Dictionary::getBitsFromByteList(
        dictionary.bytesList.row(layout.ids[i]), dictionary.markerSize);
    drawMarker(bits, upper_left.x(), upper_left.y(), spec.marker, &sheet);
  }
  return sheet;
}

}  // namespace palpa::ar
