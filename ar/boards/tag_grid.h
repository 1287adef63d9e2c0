#pragma once

#include "ar/boards/board.h"
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

}  // namespace palpa::ar
