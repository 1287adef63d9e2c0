#include "apps/twin/virtual_camera_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <opencv2/imgproc.hpp>

#include "anatomy/base/random.h"

namespace palpa::twin::picture {

std::uint64_t randomBits(std::uint64_t stream, std::uint64_t counter) {
  return splitMix64(splitMix64(stream) ^ counter);
}

double uniform(std::uint64_t stream, std::uint64_t counter) {
  return double(randomBits(stream, counter) >> 11) * 0x1p-53;
}

std::vector<std::int16_t> noiseBank(std::uint64_t stream, double sigma, std::size_t count) {
  const double scale = sigma / std::sqrt(8 * 65535.0 / 12);  // variance of a byte: (256^2 - 1) / 12
  std::vector<std::int16_t> bank(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t bits = randomBits(stream, i);
    int sum = -8 * 255 / 2;
    for (int byte = 0; byte < 8; ++byte) sum += int((bits >> (8 * byte)) & 255U);
    bank[i] = std::int16_t(std::lround(sum * scale));
  }
  return bank;
}

namespace {

// Gray levels, as kPaper: a matt laser print under even light, and a beech table.
constexpr double kInk = 28, kTable = 105;
constexpr double kStructure = 10;  // gray levels, amplitude of the table's grain
constexpr int kWaves = 12;

struct Wave {
  double kx, ky, phase;  // rad/m, rad
};

/// Long waves along x, short ones across: the look of wood, at 3 to 40 cycles a metre.
std::vector<Wave> grain(std::uint64_t seed) {
  std::vector<Wave> waves;
  for (std::uint64_t i = 0; i < kWaves; ++i) {
    const auto draw = [&](std::uint64_t n) { return uniform(seed, 3 * i + n); };
    const double turn = 2 * std::numbers::pi;
    waves.push_back({turn * 3 * draw(0), turn * (5 + 35 * draw(1)), turn * draw(2)});
  }
  return waves;
}

/// 1 in the middle, 0 on the border, smooth.
double fade(double share) {
  const double t = std::clamp((1 - std::abs(share)) * 4, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

float tone(const std::vector<Wave>& waves, double x, double y) {
  double sum = 0;
  for (const Wave& wave : waves) sum += std::sin(wave.kx * x + wave.ky * y + wave.phase);
  return float(kStructure * sum / std::sqrt(double(kWaves)));
}

/// The grain is smooth: it is drawn at 4 mm and enlarged.
cv::Mat drawGrain(const Eigen::Vector2d& size, cv::Size pixels, std::uint64_t seed) {
  const std::vector<Wave> waves = grain(seed);
  cv::Mat coarse(int(size.y() / 0.004), int(size.x() / 0.004), CV_32F);
  for (int v = 0; v < coarse.rows; ++v)
    for (int u = 0; u < coarse.cols; ++u) {
      const double x = (u + 0.5) / coarse.cols - 0.5, y = (v + 0.5) / coarse.rows - 0.5;
      coarse.at<float>(v, u) = float(kTable) + float(fade(2 * x) * fade(2 * y)) *
                                                   tone(waves, x * size.x(), y * size.y());
    }
  cv::Mat table;
  cv::resize(coarse, table, pixels, 0, 0, cv::INTER_LINEAR);
  return table;
}

/// An odd or even number of pixels, as `like` has, so that two pictures share their centre.
int sameParity(int count, int like) { return count + (count + like) % 2; }

}  // namespace

Eigen::Vector2d tableSize(const ar::TagGridSpec& board) {
  return 2.5 * ar::sheetSize(board).maxCoeff() * Eigen::Vector2d(1.2, 1);
}

cv::Mat drawSheet(const ar::TagGridSpec& board, double texel) {
  cv::Mat sheet;
  ar::drawTagGrid(board, 1 / texel).convertTo(sheet, CV_8U, (kPaper - kInk) / 255, kInk);
  return sheet;
}

cv::Mat drawTable(const ar::TagGridSpec& board, double texel, std::uint64_t seed) {
  const cv::Mat sheet = drawSheet(board, texel);
  const Eigen::Vector2d size = tableSize(board);
  const cv::Size pixels(sameParity(int(size.x() / texel), sheet.cols),
                        sameParity(int(size.y() / texel), sheet.rows));
  cv::Mat table;
  drawGrain(size, pixels, seed).convertTo(table, CV_8U);
  const cv::Rect place((pixels.width - sheet.cols) / 2, (pixels.height - sheet.rows) / 2,
                       sheet.cols, sheet.rows);
  sheet.copyTo(table(place));
  return table;
}

cv::Mat drawBareTable(const ar::TagGridSpec& board, double texel, std::uint64_t seed) {
  const Eigen::Vector2d size = tableSize(board);
  const cv::Size pixels(std::max(1, int(size.x() / texel)), std::max(1, int(size.y() / texel)));
  cv::Mat table;
  drawGrain(size, pixels, seed).convertTo(table, CV_8U);
  return table;
}

cv::Mat drawWall(const cv::Mat& ray_x, const cv::Mat& ray_y, double depth, std::uint64_t seed) {
  const std::vector<Wave> waves = grain(seed);
  cv::Mat wall(ray_x.size(), CV_8U);
  for (int v = 0; v < wall.rows; ++v)
    for (int u = 0; u < wall.cols; ++u)
      wall.at<unsigned char>(v, u) = cv::saturate_cast<unsigned char>(
          float(kTable) +
          tone(waves, depth * ray_x.at<float>(v, u), depth * ray_y.at<float>(v, u)));
  return wall;
}

}  // namespace palpa::twin::picture
