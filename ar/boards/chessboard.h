#pragma once

#include "ar/boards/board.h"
#include "ar/boards/sheet.h"

namespace palpa::ar {

/// Inner corners of a chessboard. W: origin at the centre of the inner corners, +x along the rows
/// of `columns` corners, +z up from the board.
///
/// Which end is which: where columns + rows is odd the colours decide, and +x points the same way
/// on the board however it is turned: the square that touches the first corner (-x, -y) from
/// inside, the one between the first two columns and rows, is black. Where columns + rows is even
/// the board looks the same after half a turn, and +x is the way along the rows that points right
/// in the picture (down when upright); such a board must not be turned by more than a quarter
/// between two pictures. As many columns as rows are refused: they look the same, but for colour,
/// after a quarter turn.
class Chessboard : public Board {
 public:
  /// `half_window_px`: half the side of the square in which a corner is located, as other programs
  /// let it be given; 0: three tenths of the smallest distance between corners, so that it never
  /// reaches past a neighbouring edge.
  Chessboard(cv::Size inner_corners, double square, int half_window_px = 0);
  std::vector<BoardPoint> detect(const cv::Mat& image) const override;
  std::string describe() const override;

 private:
  cv::Size size_;
  double square_;
  int half_window_px_;
};

/// With a margin of one square; the square at the lower left is black.
Sheet chessboardSheet(cv::Size inner_corners, double square);

}  // namespace palpa::ar
