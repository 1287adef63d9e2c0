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
};

/// AprilTag grid of ours: columns x rows of tag36h11, ids row by row from the corner at -x, -y.
/// The origin W is the grid's centre, +x along rows, +y away from the reader, +z up.
struct TagGridSpec {
  int columns = 6, rows = 4;
  double tag_size = 0.030;  ///< black border to black border, metres
  double spacing = 0.0075;  ///< gap between neighbouring tags, metres
  int first_id = 0;
};

inline constexpr int kTagFamilySize = 587;  ///< tag36h11 has the ids 0 to 586

/// Throws UsageError when such a grid cannot be made or seen: sizes, ids beyond the family, or gaps
/// narrower than the white cell (an eighth of the tag) that the detector needs round each tag.
void validate(const TagGridSpec& spec, const std::string& where);

/// Width and height of the printed sheet, metres: the grid and a white margin of one spacing.
Eigen::Vector2d sheetSize(const TagGridSpec& spec);

/// Corners of one tag of the grid in W, in the detector's order: as the reader sees the upright
/// tag, lower left, lower right, upper right, upper left.
std::array<Vec3, 4> tagCorners(const TagGridSpec& spec, int id);

/// A grid from a file such as assets/boards/table.json: columns, rows, tag_size_m, spacing_m,
/// first_id, family. Throws Error with file and field.
TagGridSpec readTagGrid(const std::filesystem::path& file);

std::unique_ptr<Board> makeBoard(const TagGridSpec& spec, double decimate = 2.0);

/// `spec`: "tags:6x4:0.030:0.0075" (an id to start from may follow), "chessboard:9x6:0.025" (inner
/// corners : square), "tag36h11:0.05" (any single tags of that size, no grid; W is the centre of
/// the tag that is seen largest). Throws UsageError naming what is known.
std::unique_ptr<Board> makeBoard(const std::string& spec, double decimate = 2.0);

/// A single detected tag, for pictures without a grid.
struct Tag {
  int id;
  Eigen::Vector2d corners[4];  ///< OpenCV pixel coordinates, order of the AprilTag library
};
std::vector<Tag> detectTags(const cv::Mat& gray, double decimate = 1.0);

/// The grid as a picture (white margin of one spacing), `px_per_m` pixels a metre, for print and
/// bench. +x is right, +y is up. Each pixel holds the exact share of white in its square: crisp
/// where cells fall on whole pixels, and true to the geometry where they do not.
cv::Mat drawTagGrid(const TagGridSpec& spec, double px_per_m);

}  // namespace palpa::ar
