#include "ar/boards/chessboard.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "anatomy/base/error.h"
#include "ar/boards/gray_picture.h"

namespace palpa::ar {
namespace {

using Corners = std::vector<cv::Point2f>;

bool find(const cv::Mat& gray, cv::Size size, Corners* corners) {
  const int flags = cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE;
  if (cv::findChessboardCorners(gray, size, *corners, flags | cv::CALIB_CB_FAST_CHECK)) return true;
  return cv::findChessboardCorners(gray, size, *corners, flags);
}

/// Half the side of the square in which a corner is located: three tenths of the smallest distance
/// between neighbours. More pixels mean less noise, but a window that reaches past a neighbouring
/// edge pulls the corner there, and the outermost squares of a board are often cut narrow.
int halfWindow(const Corners& corners, cv::Size size) {
  double smallest = 1e9;
  for (int i = 0; i < size.area(); ++i) {
    const cv::Point2f& here = corners[std::size_t(i)];
    if (i % size.width > 0)
      smallest = std::min(smallest, cv::norm(here - corners[std::size_t(i - 1)]));
    if (i >= size.width)
      smallest = std::min(smallest, cv::norm(here - corners[std::size_t(i - size.width)]));
  }
  return std::clamp(int(0.3 * smallest), 2, 15);
}

/// `half`: 0 for what suits the board.
void refine(const cv::Mat& gray, cv::Size size, int half, Corners* corners) {
  const cv::TermCriteria enough(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 50, 1e-3);
  if (half == 0) half = halfWindow(*corners, size);
  cv::cornerSubPix(gray, *corners, {half, half}, {-1, -1}, enough);
}

/// Corners as rows of `size.width`, whatever way round the finder gave them.
class Lattice {
 public:
  Lattice(Corners corners, cv::Size size) : corners_(std::move(corners)), size_(size) {}

  const cv::Point2f& at(int column, int row) const {
    return corners_[std::size_t(row * size_.width + column)];
  }
  cv::Point2f alongX() const {
    return at(size_.width - 1, 0) - at(0, 0) + at(size_.width - 1, size_.height - 1) -
           at(0, size_.height - 1);
  }
  cv::Point2f alongY() const {
    return at(0, size_.height - 1) - at(0, 0) + at(size_.width - 1, size_.height - 1) -
           at(size_.width - 1, 0);
  }
  void flipRows() {
    for (int row = 0; row < size_.height; ++row) {
      const auto start = corners_.begin() + row * size_.width;
      std::reverse(start, start + size_.width);
    }
  }
  void halfTurn() { std::reverse(corners_.begin(), corners_.end()); }

  /// The middle of the square between columns 0, 1 and rows 0, 1 at one end, or of its opposite.
  cv::Point2f endSquare(bool far) const {
    const int c = far ? size_.width - 2 : 0, r = far ? size_.height - 2 : 0;
    return (at(c, r) + at(c + 1, r) + at(c, r + 1) + at(c + 1, r + 1)) / 4;
  }

 private:
  Corners corners_;
  cv::Size size_;
};

float brightness(const cv::Mat& gray, cv::Point2f centre) {
  cv::Mat patch;
  cv::getRectSubPix(gray, {3, 3}, centre, patch);
  return float(cv::mean(patch)[0]);
}

/// See the class: +z up makes x right, y up in the picture turn counter-clockwise.
void orient(const cv::Mat& gray, cv::Size size, Lattice* lattice) {
  if (lattice->alongX().cross(lattice->alongY()) > 0) lattice->flipRows();
  bool turn = false;
  if ((size.width + size.height) % 2 == 1) {
    turn = brightness(gray, lattice->endSquare(false)) > brightness(gray, lattice->endSquare(true));
  } else {
    const cv::Point2f x = lattice->alongX();
    const bool upright = std::abs(x.x) < 0.1F * std::abs(x.y);
    turn = upright ? x.y < 0 : x.x < 0;
  }
  if (turn) lattice->halfTurn();
}

}  // namespace

Chessboard::Chessboard(cv::Size inner_corners, double square, int half_window_px)
    : size_(inner_corners), square_(square), half_window_px_(half_window_px) {
  const auto good = [](int n) { return n >= 3 && n <= 100; };
  if (!good(size_.width) || !good(size_.height) || size_.width == size_.height)
    throw UsageError(
        "a chessboard needs 3 to 100 inner corners each way, not as many columns as rows",
        "chessboard", "Count the corners where four squares meet, as in 9x6.");
  if (half_window_px < 0 || half_window_px > 50)
    throw UsageError("the window must be 0 to 50 px", "chessboard",
                     "Leave it out: it is then fitted to the board.");
  if (!(square >= 0.0005 && square <= 2))
    throw UsageError("the square must be 0.0005 to 2 m", "chessboard", "Give metres, as in 0.025.");
}

std::vector<BoardPoint> Chessboard::detect(const cv::Mat& image) const {
  const cv::Mat gray = grayPicture(image);
  Corners corners;
  if (std::min(gray.cols, gray.rows) < 32 || !find(gray, size_, &corners)) return {};
  refine(gray, size_, half_window_px_, &corners);
  Lattice lattice(std::move(corners), size_);
  orient(gray, size_, &lattice);
  std::vector<BoardPoint> points;
  for (int row = 0; row < size_.height; ++row)
    for (int column = 0; column < size_.width; ++column) {
      const cv::Point2f& p = lattice.at(column, row);
      points.push_back({Vec3((column - (size_.width - 1) / 2.0) * square_,
                             (row - (size_.height - 1) / 2.0) * square_, 0),
                        {p.x, p.y}});
    }
  return points;
}

std::string Chessboard::describe() const {
  std::ostringstream text;
  text << "chessboard with " << size_.width << " x " << size_.height
       << " inner corners, squares of " << square_ * 1000 << " mm";
  return text.str();
}

Sheet chessboardSheet(cv::Size inner_corners, double square) {
  const Chessboard valid(inner_corners, square);  // throws where there can be none
  const Eigen::Vector2d squares(inner_corners.width + 1, inner_corners.height + 1);
  Sheet sheet{"chessboard", (squares + Eigen::Vector2d(2, 2)) * square, square, {}};
  for (int row = 0; row <= inner_corners.height; ++row)
    for (int col = 0; col <= inner_corners.width; ++col)
      if ((row + col) % 2 == 0)
        sheet.black.push_back(
            {(col - squares.x() / 2) * square, (row - squares.y() / 2) * square, square, square});
  return sheet;
}

}  // namespace palpa::ar
