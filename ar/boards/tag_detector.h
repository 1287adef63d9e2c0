#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "ar/boards/board.h"

namespace palpa::ar {

/// The AprilTag library's tag36h11 detector (Wang & Olson 2016) behind C++ types. The one adapter
/// for its pixel frame: the library puts the centre of the first pixel at (0.5, 0.5), OpenCV at (0,
/// 0).
///
/// Building one decodes the family into a table of some 20 megabytes: keep it. Calls from several
/// threads take turns.
class TagDetector {
 public:
  struct Settings {
    double decimate = 2.0;   ///< quads are found in a picture smaller by this, corners in full
    int bits_corrected = 2;  ///< 0 to 2; more corrections find more tags that are not there
    double min_margin = 0;   ///< gray levels between bits and their threshold, mean over the tag
    int border_bits = 1;     ///< width of the tags' black border in cells, 1 or 2
  };
  explicit TagDetector(const Settings& settings);
  ~TagDetector();

  /// Every tag seen, by id, then by place in the picture. An id may come twice.
  std::vector<Tag> detect(const cv::Mat& image) const;

 private:
  struct Library;
  std::unique_ptr<Library> library_;
};

/// How boards look for tags. Their corners feed calibrations: one corrected bit and a margin of ten
/// gray levels keep out the chance decodings that the library's own limits (two bits, none) let
/// through.
TagDetector::Settings boardTagSettings(double decimate, int border_bits);

}  // namespace palpa::ar
