#include "apps/bench/false_pictures.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <string>

#include "apps/runtime/random.h"
#include "ar/board.h"

namespace palpa::bench {
namespace {

using runtime::RandomStream;

int below(RandomStream& random, int n) {
  return static_cast<int>(random.bits() % static_cast<std::uint64_t>(n));
}

cv::Mat noise(cv::Size size, RandomStream& random) {
  const int grain = 1 << below(random, 4);
  cv::Mat fine(size.height / grain, size.width / grain, CV_8U), picture;
  for (int row = 0; row < fine.rows; ++row)
    for (int column = 0; column < fine.cols; ++column)
      fine.at<unsigned char>(row, column) = static_cast<unsigned char>(random.bits() >> 56);
  cv::resize(fine, picture, size, 0, 0, below(random, 2) ? cv::INTER_NEAREST : cv::INTER_CUBIC);
  return picture;
}

cv::Mat text(cv::Size size, RandomStream& random) {
  cv::Mat page(size, CV_8U, cv::Scalar(240));
  const double scale = random.uniform(0.4, 2.0);
  const int font = below(random, 8), thickness = 1 + below(random, 4);
  for (int y = static_cast<int>(25 * scale); y < size.height; y += static_cast<int>(30 * scale)) {
    std::string line;
    for (int k = 0; k < 100; ++k) line += static_cast<char>('!' + below(random, 94));
    cv::putText(page, line, {5, y}, font, scale, 10, thickness, cv::LINE_AA);
  }
  return page;
}

/// Squares of one size in rows, `cellsOf(i)` a pixel a cell with a white border.
template <class CellsOf>
cv::Mat sheet(cv::Size size, RandomStream& random, const CellsOf& cells_of) {
  cv::Mat page(size, CV_8U, cv::Scalar(255));
  const int side = 30 + below(random, 90), pitch = side + side / 3;
  int i = 0;
  for (int y = 10; y + side < size.height; y += pitch)
    for (int x = 10; x + side < size.width; x += pitch)
      cv::resize(cells_of(i++), page(cv::Rect(x, y, side, side)), {side, side}, 0, 0,
                 cv::INTER_NEAREST);
  return page;
}

cv::Mat randomCells(RandomStream& random) {
  cv::Mat tag(10, 10, CV_8U, cv::Scalar(255));
  tag(cv::Rect(1, 1, 8, 8)) = 0;
  for (int j = 0; j < 36; ++j)
    if (below(random, 2)) tag.at<unsigned char>(2 + j / 6, 2 + j % 6) = 255;
  return tag;
}

}  // namespace

cv::Mat falsePicture(int i, cv::Size size, std::uint64_t seed) {
  constexpr int kLeastCodes = 30;  // of tag16h5, the smallest family
  RandomStream random(seed + static_cast<std::uint64_t>(i) * 7919, "bench.tracking.false");
  switch (i % 4) {
    case 0:
      return noise(size, random);
    case 1:
      return text(size, random);
    case 2: {
      const auto& families = ar::foreignTagFamilies();
      const std::string& family =
          families[static_cast<std::size_t>(below(random, static_cast<int>(families.size())))];
      return sheet(size, random,
                   [&](int k) { return ar::drawForeignTag(family, k % kLeastCodes); });
    }
    default:
      return sheet(size, random, [&](int) { return randomCells(random); });
  }
}

}  // namespace palpa::bench
