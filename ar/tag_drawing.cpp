#include <algorithm>
#include <cmath>
#include <memory>

#include "anatomy/geometry/error.h"
#include "ar/board.h"

extern "C" {
#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
}

namespace palpa::ar {
namespace {

using Family = std::unique_ptr<apriltag_family_t, decltype(&tag36h11_destroy)>;

/// Cells of one tag, border included, row by row from the top: true is black. The bits of a code
/// run from its most significant one; (bit_x, bit_y) are counted from the border's upper left cell.
std::vector<bool> blackCells(const apriltag_family_t& family, int id) {
  const int n = family.width_at_border;
  std::vector<bool> black(std::size_t(n * n), true);
  for (unsigned i = 0; i < family.nbits; ++i) {
    const bool white = (family.codes[id] >> (family.nbits - 1 - i)) & 1U;
    black[std::size_t(family.bit_y[i]) * std::size_t(n) + family.bit_x[i]] = !white;
  }
  return black;
}

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

/// `left`, `top`: the tag's upper left corner in pixels; `cell`: pixels a cell.
void coverTag(const apriltag_family_t& family, int id, double left, double top, double cell,
              cv::Mat* share) {
  const std::vector<bool> black = blackCells(family, id);
  const int n = family.width_at_border;
  for (int row = 0; row < n; ++row)
    for (int col = 0; col < n; ++col)
      if (black[std::size_t(row * n + col)])
        cover(left + col * cell, left + (col + 1) * cell, top + row * cell, top + (row + 1) * cell,
              share);
}

/// Off by rounding only, a whole number is meant: 0.240 m at 1000 px/m are 240 px, not 241.
int roundUp(double pixels) { return int(std::ceil(pixels - 1e-6)); }

}  // namespace

cv::Mat drawTagGrid(const TagGridSpec& spec, double px_per_m) {
  validate(spec, "tag grid");
  const Eigen::Vector2d size = sheetSize(spec) * px_per_m;
  if (!(spec.tag_size * px_per_m >= 8 && size.maxCoeff() <= 30000))
    throw UsageError("a tag needs at least 8 pixels and the sheet at most 30000", "tag grid",
                     "Choose another resolution.");
  const Family family(tag36h11_create(), &tag36h11_destroy);
  cv::Mat black(roundUp(size.y()), roundUp(size.x()), CV_32F, cv::Scalar(0));
  for (int id = spec.first_id; id < spec.first_id + spec.columns * spec.rows; ++id) {
    const Vec3 upper_left = tagCorners(spec, id)[3] * px_per_m;
    coverTag(*family, id, black.cols / 2.0 + upper_left.x(), black.rows / 2.0 - upper_left.y(),
             spec.tag_size * px_per_m / family->width_at_border, &black);
  }
  cv::Mat picture;
  black.convertTo(picture, CV_8U, -255, 255);
  return picture;
}

}  // namespace palpa::ar
