#pragma once

#include "ar/boards/board.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
#include <memory>
#include "ar/boards/tag_detector.h"

namespace palpa::ar {

/// A grid of tags with known places. Tags with foreign ids are ignored; an id seen twice is left
/// out altogether, because nothing says which of the two is ours.
class TagGridBoard : public Board {
 public:
  TagGridBoard(const TagGridSpec& spec, double decimate);
  std::vector<BoardPoint> detect(const cv::Mat& image) const override;
  std::string describe() const override;
  int leastPoints() const override { return spec_.columns * spec_.rows > 1 ? 8 : 4; }

 private:
  TagGridSpec spec_;
  TagDetector detector_;
};

/// Loose tags of one size: W is the centre of the tag seen largest (the lowest id among equals).
class SingleTagBoard : public Board {
 public:
  SingleTagBoard(double tag_size, double decimate);
  std::vector<BoardPoint> detect(const cv::Mat& image) const override;
  std::string describe() const override;
  int leastPoints() const override { return 4; }

 private:
  double tag_size_;
  TagDetector detector_;
};

using TagFamily = std::unique_ptr<apriltag_family_t, decltype(&tag36h11_destroy)>;

/// The family tag36h11 with a black border `border_bits` cells wide, 1 or 2. The codes are the
/// same; a border of two cells, as Kalibr prints it, makes the tag 10 cells wide instead of 8. Part
/// of the tags with the other border may decode, because the cells sampled lie within half a cell
/// of the true ones; they have their own ids and the same outer corners then. The caller owns the
/// family, which must outlive its detector.
TagFamily makeTagFamily(int border_bits);

}  // namespace palpa::ar
