#include "ar/chessboard.h"
#include "ar/paper.h"

namespace palpa::ar {

cv::Mat drawChessboard(cv::Size inner_corners, double square, double px_per_m) {
  const Chessboard valid(inner_corners, square);  // throws where there can be none
  const Eigen::Vector2d squares(inner_corners.width + 1, inner_corners.height + 1);
  Paper paper((squares + Eigen::Vector2d(2, 2)) * square, px_per_m, square, "chessboard");
  for (int row = 0; row <= inner_corners.height; ++row)
    for (int col = 0; col <= inner_corners.width; ++col)
      if ((row + col) % 2 == 0)
        paper.blacken((col - squares.x() / 2) * square, (row - squares.y() / 2) * square, square,
                      square);
  return paper.picture();
}

}  // namespace palpa::ar
