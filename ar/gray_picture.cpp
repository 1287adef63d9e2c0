#include "ar/gray_picture.h"

#include <opencv2/imgproc.hpp>

#include "anatomy/geometry/error.h"

namespace palpa::ar {

cv::Mat grayPicture(const cv::Mat& image) {
  if (image.dims == 2 && !image.empty()) {
    if (image.type() == CV_8UC1) return image;
    cv::Mat gray;
    if (image.type() == CV_8UC3) {
      cv::cvtColor(image, gray, cv::COLOR_BGR2GRAY);
      return gray;
    }
  }
  throw Error("the picture is empty or not 8-bit gray or BGR", "board detection",
              "Convert the picture to 8 bits a channel, one or three channels.");
}

}  // namespace palpa::ar
