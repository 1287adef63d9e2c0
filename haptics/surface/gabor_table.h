#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace palpa::haptics {

/// Where a surface rises under a probe that moves in one of 32 directions at one of five scales: a
/// bit each for every pixel of a square height map, set where the response of the antisymmetric
/// Gabor filter of that direction and scale exceeds its threshold. 160 bits a pixel, pixels in
/// tiles of 8 x 8, so that a moving probe stays in a tile: 1024 x 1024 pixels are 20,971,520 bytes.
/// Looking up neither allocates nor locks. Pixel (i, j) has its middle at x = (i + 0.5) side / size
/// - side / 2, y likewise.
class GaborTable {
 public:
  static constexpr int kDirections = 32, kScales = 5, kTile = 8;

  /// `size` pixels a side, a multiple of 8; `side` in U. Throws Error.
  GaborTable(int size, double side);

  int size() const noexcept { return size_; }
  double side() const noexcept { return side_; }
  std::size_t bytes() const noexcept { return words_.size() * sizeof(std::uint32_t); }

  void set(int i, int j, int direction, int scale, bool rises) noexcept;
  bool pixel(int i, int j, int direction, int scale) const noexcept {
    return words_[word(i, j, scale)] >> direction & 1u;
  }
  /// Of the pixel under (x, y); false beyond the map.
  bool rises(double x, double y, int direction, int scale) const noexcept {
    const double u = (x / side_ + 0.5) * size_, v = (y / side_ + 0.5) * size_;
    if (!(u >= 0 && v >= 0 && u < size_ && v < size_)) return false;
    return pixel(static_cast<int>(u), static_cast<int>(v), direction, scale);
  }

  /// Index of the direction 2 pi k / 32 nearest to (vx, vy), not both 0.
  static int directionOf(double vx, double vy) noexcept;
  /// clamp(floor(log2(v / v_0)), 0, 4): of a speed v, where v_0 is the one at which scanning
  /// begins.
  static int scaleOf(double speed, double first) noexcept;

 private:
  std::size_t word(int i, int j, int scale) const noexcept {
    const std::size_t tile = static_cast<std::size_t>((j / kTile) * (size_ / kTile) + i / kTile);
    return (tile * kTile * kTile + static_cast<std::size_t>((j % kTile) * kTile + i % kTile)) *
               kScales +
           static_cast<std::size_t>(scale);
  }

  int size_;
  double side_;
  std::vector<std::uint32_t> words_;
};

}  // namespace palpa::haptics
