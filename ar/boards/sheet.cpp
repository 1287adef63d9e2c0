#include "ar/boards/sheet.h"

#include <algorithm>
#include <cmath>

#include "anatomy/base/error.h"
#include "ar/boards/board.h"
#include "ar/boards/tag_grid.h"

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

namespace {

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

void drawTag(const apriltag_family_t& family, int id, const TagGridSpec& spec, Sheet* sheet) {
  const std::vector<bool> black = blackCells(family, id);
  const int n = family.width_at_border;
  const double cell = spec.tag_size / n;
  const Vec3 upper_left = tagCorners(spec, id)[3];
  for (int row = 0; row < n; ++row)
    for (int col = 0; col < n; ++col)
      if (black[std::size_t(row * n + col)])
        sheet->black.push_back(
            {upper_left.x() + col * cell, upper_left.y() - (row + 1) * cell, cell, cell});
}

/// One at every crossing of two gaps, the gap round the grid included: each touches the corners of
/// up to four tags.
void drawCornerSquares(const TagGridSpec& spec, Sheet* sheet) {
  const double pitch = spec.tag_size + spec.spacing;
  for (int row = 0; row <= spec.rows; ++row)
    for (int col = 0; col <= spec.columns; ++col)
      sheet->black.push_back({(col - spec.columns / 2.0) * pitch - spec.spacing / 2,
                              (row - spec.rows / 2.0) * pitch - spec.spacing / 2, spec.spacing,
                              spec.spacing});
}

}  // namespace

Sheet sheetOf(const TagGridSpec& spec) {
  validate(spec, "tag grid");
  const TagFamily family = makeTagFamily(spec.border_bits);
  Sheet sheet{"tag grid", sheetSize(spec), spec.tag_size / family->width_at_border, {}};
  for (int id = spec.first_id; id < spec.first_id + spec.columns * spec.rows; ++id)
    drawTag(*family, id, spec, &sheet);
  if (spec.corner_squares) drawCornerSquares(spec, &sheet);
  return sheet;
}

cv::Mat drawTagGrid(const TagGridSpec& spec, double px_per_m) {
  return pictureOf(sheetOf(spec), px_per_m);
}

}  // namespace palpa::ar
