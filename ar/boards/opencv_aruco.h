#pragma once

#include <opencv2/core.hpp>

#if CV_VERSION_MAJOR > 4 || CV_VERSION_MINOR >= 7
#define PALPA_ARUCO_IN_OBJDETECT 1
#include <opencv2/objdetect/charuco_detector.hpp>
#else
#include <opencv2/aruco/charuco.hpp>
#endif

#include <vector>

#include "ar/boards/charuco.h"

/// OpenCV's ArUco: a module of its own with open members up to OpenCV 4.6, part of objdetect with
/// getters since 4.7. Layout (that of 4.6 and later), ids and bits are the same in both. Only this
/// file knows the difference.
namespace palpa::ar::aruco {

using Dictionary = cv::aruco::Dictionary;

/// Markers in a picture.
struct Markers {
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
};

/// A ChArUco board; lengths in metres, OpenCV's frame.
struct CharucoPattern {
  cv::Ptr<cv::aruco::CharucoBoard> opencv;
  Dictionary dictionary;
  std::vector<int> ids;                           ///< of the markers
  std::vector<std::vector<cv::Point3f>> markers;  ///< their corners
  std::vector<cv::Point3f> corners;               ///< of the chessboard
  std::vector<std::vector<int>> nearest;          ///< to each of these: indices of markers
};

#ifdef PALPA_ARUCO_IN_OBJDETECT

inline Dictionary predefined(int name) { return cv::aruco::getPredefinedDictionary(name); }

inline CharucoPattern makeBoard(cv::Size squares, float square, float marker,
                                const Dictionary& dictionary) {
  const auto board = cv::makePtr<cv::aruco::CharucoBoard>(squares, square, marker, dictionary);
  return {.opencv = board,
          .dictionary = dictionary,
          .ids = board->getIds(),
          .markers = board->getObjPoints(),
          .corners = board->getChessboardCorners(),
          .nearest = board->getNearestMarkerIdx()};
}

inline Markers detectMarkers(const cv::Mat& gray, const Dictionary& dictionary) {
  Markers seen;
  cv::aruco::ArucoDetector(dictionary).detectMarkers(gray, seen.corners, seen.ids);
  return seen;
}

/// The chessboard's corners that have two markers of those seen beside them.
inline void interpolateCorners(const cv::Mat& gray, const CharucoPattern& board,
                               const Markers& seen, std::vector<cv::Point2f>* pixels,
                               std::vector<int>* ids) {
  cv::aruco::CharucoDetector(*board.opencv)
      .detectBoard(gray, *pixels, *ids, seen.corners, seen.ids);
}

inline void draw(const CharucoPattern& board, cv::Size size, int margin, cv::Mat* to) {
  board.opencv->generateImage(size, *to, margin);
}

inline void drawMarker(const Dictionary& dictionary, int id, int side, cv::Mat* to) {
  dictionary.generateImageMarker(id, side, *to);
}

#else

inline Dictionary predefined(int name) { return *cv::aruco::getPredefinedDictionary(name); }

inline CharucoPattern makeBoard(cv::Size squares, float square, float marker,
                                const Dictionary& dictionary) {
  const auto board = cv::aruco::CharucoBoard::create(squares.width, squares.height, square, marker,
                                                     cv::makePtr<Dictionary>(dictionary));
  return {.opencv = board,
          .dictionary = dictionary,
          .ids = board->ids,
          .markers = board->objPoints,
          .corners = board->chessboardCorners,
          .nearest = board->nearestMarkerIdx};
}

inline Markers detectMarkers(const cv::Mat& gray, const Dictionary& dictionary) {
  Markers seen;
  cv::aruco::detectMarkers(gray, cv::makePtr<Dictionary>(dictionary), seen.corners, seen.ids);
  return seen;
}

/// The chessboard's corners that have two markers of those seen beside them.
inline void interpolateCorners(const cv::Mat& gray, const CharucoPattern& board,
                               const Markers& seen, std::vector<cv::Point2f>* pixels,
                               std::vector<int>* ids) {
  cv::aruco::interpolateCornersCharuco(seen.corners, seen.ids, gray, board.opencv, *pixels, *ids);
}

inline void draw(const CharucoPattern& board, cv::Size size, int margin, cv::Mat* to) {
  board.opencv->draw(size, *to, margin);
}

inline void drawMarker(const Dictionary& dictionary, int id, int side, cv::Mat* to) {
  const_cast<Dictionary&>(dictionary).drawMarker(id, side, *to);
}

#endif

}  // namespace palpa::ar::aruco

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
