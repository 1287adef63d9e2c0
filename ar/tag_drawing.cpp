#include "anatomy/geometry/error.h"
#include "ar/board.h"
#include "ar/sheet.h"
#include "ar/tag_family.h"

namespace palpa::ar {
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
