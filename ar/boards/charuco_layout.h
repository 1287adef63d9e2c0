#pragma once

#include "ar/boards/charuco.h"
#include "ar/boards/opencv_aruco.h"

namespace palpa::ar {

/// OpenCV's own board for a valid spec. Its frame: origin at the upper left corner of the pattern,
/// x right, y towards the reader, z into the board.
aruco::CharucoPattern charucoLayout(const CharucoSpec& spec);

/// The middles of the markers by id, metres, in OpenCV's frame, as OpenCV before 4.6 laid them out:
/// the lower left square black, ids row by row from the upper left all the same.
std::vector<cv::Point2d> charucoMarkersBefore46(const CharucoSpec& spec);

/// From OpenCV's frame to W.
inline Vec3 charucoPointW(const CharucoSpec& spec, const cv::Point3f& p) {
  return {double(p.x) - spec.columns * spec.square / 2, spec.rows * spec.square / 2 - double(p.y),
          0};
}

}  // namespace palpa::ar
