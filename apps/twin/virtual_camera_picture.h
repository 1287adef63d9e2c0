#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include <opencv2/core.hpp>

#include "anatomy/geometry/pose.h"
#include "ar/boards/board.h"

namespace palpa::twin::picture {

/// Counter-based random numbers: the SplitMix64 finaliser (Steele, Lea, Flood 2014) of stream and
/// counter. No state, so any order of drawing gives the same numbers.
std::uint64_t randomBits(std::uint64_t stream, std::uint64_t counter);

/// In [0, 1), 53 bits.
double uniform(std::uint64_t stream, std::uint64_t counter);

/// `count` samples of nearly Gaussian noise (the sum of eight bytes: kurtosis 2.85, nothing
/// beyond 4.9 sigma) of standard deviation `sigma`, rounded to whole numbers. Integers only: the
/// same bits on every processor.
std::vector<std::int16_t> noiseBank(std::uint64_t stream, double sigma, std::size_t count);

}  // namespace palpa::twin::picture

/// Flat things as the virtual camera sees them. P: a plane z_P = 0, +z up from its printed face.
namespace palpa::twin::picture {

/// How the rays of a camera meet a plane. For the ray through (x, y, 1) in C:
///   H (x, y, 1) = (X w, Y w, w),  (X, Y) in P in metres;  w / |height| = 1 / Z,  Z the depth in C.
/// w > 0 exactly where the ray meets the plane in front of the camera. From o + t R d = (X, Y, 0),
/// o and R position and orientation of the camera in P, d the ray.
struct RayToPlane {
  Mat3 H;
  double height = 0;  ///< of the camera over the plane, metres: negative behind its printed face
};

inline RayToPlane rayToPlane(const Pose& X_CP) {
  const Pose X_PC = X_CP.inverse();
  const Vec3 o = X_PC.translation();
  const Mat3 R = X_PC.rotation();
  Mat3 H;
  H.row(0) = o.x() * R.row(2) - o.z() * R.row(0);
  H.row(1) = o.y() * R.row(2) - o.z() * R.row(1);
  H.row(2) = R.row(2);
  return {o.z() > 0 ? Mat3(-H) : H, o.z()};
}

/// A rectangle of the picture and the box round its rays at unit depth.
struct RayBlock {
  cv::Rect pixels;
  Eigen::Vector2d low, high;
};

inline constexpr int kRayBlock = 16;  // pixels

inline std::vector<RayBlock> rayBlocks(const cv::Mat& ray_x, const cv::Mat& ray_y) {
  std::vector<RayBlock> blocks;
  const cv::Rect all(0, 0, ray_x.cols, ray_x.rows);
  for (int v = 0; v < ray_x.rows; v += kRayBlock)
    for (int u = 0; u < ray_x.cols; u += kRayBlock) {
      RayBlock block{cv::Rect(u, v, kRayBlock, kRayBlock) & all, {0, 0}, {0, 0}};
      cv::minMaxLoc(ray_x(block.pixels), &block.low.x(), &block.high.x());
      cv::minMaxLoc(ray_y(block.pixels), &block.low.y(), &block.high.y());
      blocks.push_back(block);
    }
  return blocks;
}

struct GrayTexture {
  cv::Mat gray;
  double texel = 0;  ///< metres; the texture's centre is P's origin, +y is up
};

inline constexpr double kFinestTexel = 0.00025;  // metres: a pixel at 0.15 m, focal length 600 px
inline constexpr int kTextures = 10;  // sqrt(2) apart: the coarsest is 5.7 mm, a pixel at 3.4 m
inline constexpr double kTexelsPerPixel = 1.25;  // averaging plus interpolation then match a pixel

/// Area-averaged pictures of one thing, fine to coarse, at least one, until a cell of a tag is less
/// than a texel: no tag left to see. Each is drawn when it is first looked at, because a session
/// needs one or two of ten, and the finest cost most. Any thread.
class TextureSeries {
 public:
  using Draw = std::function<cv::Mat(double texel)>;
  TextureSeries() = default;
  TextureSeries(double tag_size, const Draw& draw);
  static TextureSeries ofOne(double texel, const Draw& draw);

  /// The one whose texels are nearest to a pixel's footprint at P's origin.
  const GrayTexture& nearest(const Pose& X_CP, double focal_length_px) const;

 private:
  struct Level {
    std::once_flag drawn;
    GrayTexture texture;  ///< without its picture until it is drawn
  };
  void add(double texel);
  Draw draw_;
  std::vector<std::shared_ptr<Level>> levels_;
};

/// Metres on the plane to texels.
inline Mat3 toTexel(const GrayTexture& texture) {
  const double cu = (texture.gray.cols - 1) / 2.0, cv_ = (texture.gray.rows - 1) / 2.0;
  Mat3 to_texel;
  to_texel << 1 / texture.texel, 0, cu, 0, -1 / texture.texel, cv_, 0, 0, 1;
  return to_texel;
}

/// Where the rays (x, y, 1) of a row meet a plane, H as `RayToPlane::H` then `toTexel`: `column`
/// and `row` in 1/32 texels, to the nearest; behind the camera 0. What the border repeats is cut at
/// -100 and 20,000 texels. No branch, and nothing that might be the same memory, so that it runs on
/// vectors.
void castRow(const Eigen::Matrix3f& H, const float* __restrict x, const float* __restrict y,
             int count, std::int32_t* __restrict column, std::int32_t* __restrict row);

/// Between the four texels round each of these places, as cv::remap does it with INTER_LINEAR and
/// BORDER_REPLICATE, to the bit; but without two pictures of places, which cost more than the rest.
void readRow(const cv::Mat& gray, const std::int32_t* column, const std::int32_t* row, int count,
             unsigned char* pixel);

inline constexpr double kPaper = 222;  ///< gray level of white paper under even light

/// A table with mild structure and the printed board in its middle, seen from above: 8-bit gray, +x
/// right, +y up, W's origin at the exact centre, `texel` metres a pixel. The structure fades to an
/// even tone toward the borders, so the table may be continued by its border pixels.
cv::Mat drawTable(const ar::TagGridSpec& board, double texel, std::uint64_t seed);

/// The same table without a board.
cv::Mat drawBareTable(const ar::TagGridSpec& board, double texel, std::uint64_t seed);

/// The printed sheet alone: as the board on the table, nothing round it.
cv::Mat drawSheet(const ar::TagGridSpec& board, double texel);

/// A wall across the line of sight, with the table's tone and structure and no end: one pixel a
/// ray (x, y, 1), `depth` metres away.
cv::Mat drawWall(const cv::Mat& ray_x, const cv::Mat& ray_y, double depth, std::uint64_t seed);

/// Width and height of that table, metres: the sheet and room around it.
Eigen::Vector2d tableSize(const ar::TagGridSpec& board);

}  // namespace palpa::twin::picture
