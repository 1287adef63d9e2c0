#pragma once

#include "ar/boards/board.h"
#include "ar/boards/sheet.h"

namespace palpa::ar {

/// A chessboard with an ArUco marker in each white square (Garrido-Jurado et al. 2014; OpenCV's
/// aruco module). Points are the inner corners of the chessboard that lie beside two markers seen.
struct CharucoSpec {
  int columns = 7, rows = 5;               ///< squares
  double square = 0.030, marker = 0.022;   ///< sides, metres
  std::string dictionary = "DICT_4X4_50";  ///< OpenCV's name; ids from 0
};

/// Throws UsageError when there can be no such board: fewer than 3 x 3 squares, markers that leave
/// less than a twentieth of the square white on each side, too few markers in the dictionary.
void validate(const CharucoSpec& spec, const std::string& where);

Sheet sheetOf(const CharucoSpec& spec);

/// W: origin in the middle of the pattern, +x along the rows, +y away from the reader, +z up.
///
/// Layout: that of OpenCV 4.6 and later, where the upper left square is black and ids run row by
/// row from there. Before 4.6 the lower left square was black (later OpenCV: setLegacyPattern). The
/// two differ where the number of rows is even. Such an older sheet is not taken for ours where the
/// markers seen tell; with an odd number of columns they do not in a view without a last marker of
/// a row, and W is then a square off along x, which a camera's calibration does not notice.
class CharucoBoard : public Board {
 public:
  explicit CharucoBoard(const CharucoSpec& spec);
  ~CharucoBoard() override;
  std::vector<BoardPoint> detect(const cv::Mat& image) const override;
  std::string describe() const override;

 private:
  struct Layout;
  CharucoSpec spec_;
  std::unique_ptr<Layout> layout_;
};

}  // namespace palpa::ar
