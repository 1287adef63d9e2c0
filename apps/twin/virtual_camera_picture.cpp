#include "apps/twin/virtual_camera_picture.h"

#include <algorithm>
#include <bit>
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

TextureSeries::TextureSeries(double tag_size, const Draw& draw) : draw_(draw) {
  for (int i = 0; i < kTextures; ++i) {
    const double texel = kFinestTexel * std::pow(2.0, i / 2.0);
    if (tag_size / texel < 8) break;
    add(texel);
  }
}

TextureSeries TextureSeries::ofOne(double texel, const Draw& draw) {
  TextureSeries series;
  series.draw_ = draw;
  series.add(texel);
  return series;
}

void TextureSeries::add(double texel) {
  levels_.push_back(std::make_shared<Level>());
  levels_.back()->texture.texel = texel;
}

const GrayTexture& TextureSeries::nearest(const Pose& X_CP, double focal_length_px) const {
  const double distance = std::max(X_CP.translation().norm(), 1e-3);
  const double wanted = distance / focal_length_px / kTexelsPerPixel;
  const auto off = [&](const std::shared_ptr<Level>& level) {
    return std::abs(std::log(level->texture.texel / wanted));
  };
  Level& level = **std::min_element(levels_.begin(), levels_.end(),
                                    [&](const auto& a, const auto& b) { return off(a) < off(b); });
  std::call_once(level.drawn, [&] { level.texture.gray = draw_(level.texture.texel); });
  return level.texture;
}

namespace {

/// In 1/32 texels, to the nearest, even where two are as near. Texels that the border repeats need
/// no larger numbers.
std::int32_t fixed(float texel) {
  constexpr float kWhole = 12582912;  // 1.5 x 2^23: a float has no finer parts there
  const float high = texel < -100.F ? -100.F : texel, within = high > 20000.F ? 20000.F : high;
  return std::bit_cast<std::int32_t>(32.F * within + kWhole) - std::bit_cast<std::int32_t>(kWhole);
}

}  // namespace

void castRow(const Eigen::Matrix3f& H, const float* __restrict x, const float* __restrict y,
             int count, std::int32_t* __restrict column, std::int32_t* __restrict row) {
  const float h00 = H(0, 0), h01 = H(0, 1), h02 = H(0, 2), h10 = H(1, 0), h11 = H(1, 1),
              h12 = H(1, 2), h20 = H(2, 0), h21 = H(2, 1), h22 = H(2, 2);
  for (int u = 0; u < count; ++u) {
    const float w = h20 * x[u] + h21 * y[u] + h22;
    const float k = w > 1e-6F ? 1 / (w > 1e-6F ? w : 1e-6F) : 0.F;
    column[u] = fixed((h00 * x[u] + h01 * y[u] + h02) * k);
    row[u] = fixed((h10 * x[u] + h11 * y[u] + h12) * k);
  }
}

void readRow(const cv::Mat& gray, const std::int32_t* column, const std::int32_t* row, int count,
             unsigned char* pixel) {
  const unsigned right = unsigned(gray.cols - 1), bottom = unsigned(gray.rows - 1);
  const unsigned char* const texels = gray.data;
  const std::size_t step = gray.step[0];
  const auto clamped = [](int i, unsigned most) { return std::clamp(i, 0, int(most)); };
  for (int u = 0; u < count; ++u) {
    const int left = column[u] >> 5, top = row[u] >> 5;
    const int fx = column[u] & 31, fy = row[u] & 31;
    std::size_t next = 1, below = step, at = std::size_t(top) * step + std::size_t(left);
    if (unsigned(left) >= right || unsigned(top) >= bottom) {
      const int x0 = clamped(left, right), y0 = clamped(top, bottom);
      next = std::size_t(clamped(left + 1, right) - x0);
      below = std::size_t(clamped(top + 1, bottom) - y0) * step;
      at = std::size_t(y0) * step + std::size_t(x0);
    }
    const unsigned char* p = texels + at;
    const int over = (32 - fx) * p[0] + fx * p[next];
    const int under = (32 - fx) * p[below] + fx * p[below + next];
    pixel[u] = static_cast<unsigned char>(((32 - fy) * over + fy * under + 512) >> 10);
  }
}

}  // namespace palpa::twin::picture
