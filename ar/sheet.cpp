#include "ar/sheet.h"

#include <algorithm>
#include <cmath>

#include "anatomy/geometry/error.h"

namespace palpa::ar {
namespace {

/// Off by rounding only, a whole number is meant: 0.240 m at 1000 px/m are 240 px, not 241.
int roundUp(double pixels) { return int(std::ceil(pixels - 1e-6)); }

/// Adds to each pixel the share of it that the rectangle [x0, x1] x [y0, y1] covers (pixel edges at
/// whole numbers here, as on paper).
void cover(double x0, double x1, double y0, double y1, cv::Mat* share) {
  const auto overlap = [](double a, double b, int i) {
    return std::clamp(std::min(b, i + 1.0) - std::max(a, double(i)), 0.0, 1.0);
  };
  const int last_row = std::min(share->rows - 1, int(std::floor(y1)));
  const int last_col = std::min(share->cols - 1, int(std::floor(x1)));
  for (int v = std::max(0, int(std::floor(y0))); v <= last_row; ++v)
    for (int u = std::max(0, int(std::floor(x0))); u <= last_col; ++u)
      share->at<float>(v, u) += float(overlap(x0, x1, u) * overlap(y0, y1, v));
}

}  // namespace

cv::Mat pictureOf(const Sheet& sheet, double px_per_m) {
  if (!(sheet.smallest * px_per_m >= 1 && sheet.size.maxCoeff() * px_per_m <= 30000))
    throw UsageError("a cell needs at least a pixel and the sheet at most 30000", sheet.what,
                     "Choose another resolution.");
  cv::Mat share(roundUp(sheet.size.y() * px_per_m), roundUp(sheet.size.x() * px_per_m), CV_32F,
                0.0),
      picture;
  for (const Sheet::Black& b : sheet.black) {
    const double x = share.cols / 2.0 + b.left * px_per_m,
                 y = share.rows / 2.0 - b.bottom * px_per_m;
    cover(x, x + b.width * px_per_m, y - b.height * px_per_m, y, &share);
  }
  share.convertTo(picture, CV_8U, -255, 255);
  return picture;
}

}  // namespace palpa::ar
