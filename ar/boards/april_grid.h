#pragma once

#include <vector>

#include "ar/boards/board.h"
#include "ar/boards/tag_detector.h"

namespace palpa::ar {

/// A tag of a grid with its corners in W, numbered as its pixels are.
struct PlacedTag {
  Tag tag;
  std::array<Vec3, 4> corners_W;
};

/// Tags of one sheet, printed turned by the same unknown number of quarter turns: the tags with
/// corners in W after the turn that fits. A turn fits a pair of tags if the homography of either
/// one puts the other's middle where it is seen, to within half their distance (a wrong turn errs
/// by 1.4 distances or more, and no lens bends that much). The turn with the most such pairs wins;
/// a tag that fits less than half of the others is left out. Empty where fewer than two tags
/// remain.
std::vector<PlacedTag> placeTags(const std::vector<Tag>& tags, const TagGridSpec& spec);

/// A grid of tags with a black square at each crossing of its gaps, as Kalibr prints it (Maye,
/// Furgale & Siegwart 2013): every corner of a tag is the crossing of two edges, like a
/// chessboard's.
///
/// The squares that make the corners exact also touch the tags and break their outlines, so tags
/// are looked for in a picture whose black is shrunk, at full size and halved as often as that
/// leaves 640 pixels; `decimate` of other boards has no use here. Corners are then located as
/// saddle points in the picture itself. Left out are corners without black and white in the four
/// quarters round them (a hand, a sheet cut off at its outer tags).
///
/// Sheets come from many printers: their tags may be turned by quarter turns. The turn is that for
/// which each tag predicts where the others are; tags that contradict it are left out. One tag
/// alone cannot tell: nothing is returned then.
class AprilGridBoard : public Board {
 public:
  explicit AprilGridBoard(const TagGridSpec& spec);
  std::vector<BoardPoint> detect(const cv::Mat& image) const override;
  std::string describe() const override;

 private:
  TagGridSpec spec_;
  TagDetector detector_;
};

}  // namespace palpa::ar
