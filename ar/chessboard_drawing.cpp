#include "ar/chessboard.h"

namespace palpa::ar {

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
