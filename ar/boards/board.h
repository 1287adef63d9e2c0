#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "anatomy/geometry/pose.h"

namespace palpa::ar {

/// One point known in the world and found in the picture. W: origin on the board, +z up from it,
/// so every point of a board has z = 0.
struct BoardPoint {
  Vec3 p_W;
  Eigen::Vector2d pixel;  ///< pixel centres at whole numbers (OpenCV)
};

/// A printed pattern that defines W.
class Board {
 public:
  virtual ~Board() = default;
  /// Finds the board in an 8-bit gray or BGR picture; empty when it is not seen. Throws Error for
  /// any other kind of picture.
  virtual std::vector<BoardPoint> detect(const cv::Mat& image) const = 0;
  virtual std::string describe() const = 0;
  /// So many points in one plane are not found by chance; a board that shows fewer is believed only
  /// where it is expected.
  virtual int leastPoints() const { return 8; }
};

/// AprilTag grid: columns x rows of tag36h11, ids row by row from the corner at -x, -y.
/// The origin W is the grid's centre, +x along rows, +y away from the reader, +z up.
struct TagGridSpec {
  int columns = 6, rows = 4;
  double tag_size = 0.030;  ///< outer edge to outer edge of the black border, metres
  double spacing = 0.0075;  ///< gap between neighbouring tags, metres
  int first_id = 0;
  int border_bits = 1;          ///< width of the black border in cells, 1 or 2
  bool corner_squares = false;  ///< an AprilGrid: a black square at each crossing of the gaps
};

inline constexpr int kTagFamilySize = 587;  ///< tag36h11 has the ids 0 to 586

/// Throws UsageError when such a grid cannot be made or seen: sizes, ids beyond the family, gaps
/// narrower than the white cell (an eighth of a tag with a one-cell border, a tenth with two) that
/// the detector needs round each tag; an AprilGrid of fewer than two tags (see TagGridBoard).
void validate(const TagGridSpec& spec, const std::string& where);

/// Width and height of the printed sheet, metres: the grid, its outer corner squares if it has
/// them, and a white margin of one spacing.
Eigen::Vector2d sheetSize(const TagGridSpec& spec);

/// Corners of one tag of the grid in W, in the detector's order: as the reader sees the upright
/// tag, lower left, lower right, upper right, upper left.
std::array<Vec3, 4> tagCorners(const TagGridSpec& spec, int id);

/// A grid from a file such as assets/boards/table.json: columns, rows, tag_size_m, spacing_m,
/// first_id, family; border_bits (1) and corner_squares (0 or 1; 0) may be given. A file that ends
/// in .yaml or .yml is Kalibr's description of an AprilGrid. Throws Error with file and field.
TagGridSpec readTagGrid(const std::filesystem::path& file);

std::unique_ptr<Board> makeBoard(const TagGridSpec& spec, double decimate = 2.0);

/// `spec`, lengths in metres:
///   "tags:6x4:0.030:0.0075"         tag grid, columns x rows : size : gap, then an id to start
///   from "aprilgrid:6x6:0.088:0.3"       as Kalibr prints it, columns x rows : size : gap / size,
///   borders
///                                   two cells wide; ":1" for borders of one cell may follow
///   "chessboard:9x6:0.025"          inner corners : square
///   "charuco:7x5:0.030:0.022"       squares : square : marker, then OpenCV's dictionary
///                                   (DICT_4X4_50 where none is given)
///   "tag36h11:0.05"                 any single tags of that size, no grid; W is the centre of the
///                                   tag that is seen largest
///   "board.json", "target.yaml"     a file, see readTagGrid
/// Throws UsageError naming what is known.
std::unique_ptr<Board> makeBoard(const std::string& spec, double decimate = 2.0);

/// A single detected tag, for pictures without a grid.
struct Tag {
  int id;
  /// OpenCV pixel coordinates, order of the AprilTag library
  std::array<Eigen::Vector2d, 4> corners;
};
std::vector<Tag> detectTags(const cv::Mat& gray, double decimate = 1.0);

/// Families of tags that are not ours: "tag16h5", "tag25h9", "tag36h10", "tagCircle21h7",
/// "tagStandard41h12".
const std::vector<std::string>& foreignTagFamilies();
/// One of their tags with its white border, a pixel a cell. Throws UsageError for another name or
/// an id that the family does not have.
cv::Mat drawForeignTag(const std::string& family, int id);

/// The grid as a picture (white margin of one spacing), `px_per_m` pixels a metre, for print and
/// bench. +x is right, +y is up. Each pixel holds the exact share of white in its square: crisp
/// where cells fall on whole pixels, and true to the geometry where they do not.
cv::Mat drawTagGrid(const TagGridSpec& spec, double px_per_m);

/// Any board that makeBoard knows, drawn the same way with a white margin; for "tag36h11:..." the
/// tag with id 0.
cv::Mat drawBoard(const std::string& spec, double px_per_m);

}  // namespace palpa::ar
