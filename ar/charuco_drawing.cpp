#include "ar/charuco_layout.h"
#include "ar/sheet.h"

namespace palpa::ar {
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
  const auto layout = charucoLayout(spec);
  const cv::aruco::Dictionary& dictionary = *layout->dictionary;
  const Eigen::Vector2d size = Eigen::Vector2d(spec.columns + 2, spec.rows + 2) * spec.square;
  Sheet sheet{"ChArUco board", size, spec.marker / (dictionary.markerSize + 2), {}};
  drawSquares(spec, &sheet);
  for (std::size_t i = 0; i < layout->ids.size(); ++i) {
    const Vec3 upper_left = charucoPointW(spec, layout->objPoints[i][0]);
    const cv::Mat bits = cv::aruco::Dictionary::getBitsFromByteList(
        dictionary.bytesList.row(layout->ids[i]), dictionary.markerSize);
    drawMarker(bits, upper_left.x(), upper_left.y(), spec.marker, &sheet);
  }
  return sheet;
}

}  // namespace palpa::ar
