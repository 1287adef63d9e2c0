#include "haptics/surface/gabor_table.h"

#include <cmath>
#include <string>

#include "anatomy/geometry/error.h"

namespace palpa::haptics {
namespace {

constexpr int kMostPixels = 8192;  // a side: 1.3 GB
constexpr double kGaborTurn = 6.283185307179586;

std::size_t wordsOf(int size, double side) {
  if (size <= 0 || size > kMostPixels || size % GaborTable::kTile != 0)
    throw Error("a map cannot have " + std::to_string(size) + " pixels a side", "Gabor table",
                "Take a multiple of 8, at most 8192");
  if (!(side > 0) || !std::isfinite(side))
    throw Error("a map's side must be positive", "Gabor table", "Give the floor's side");
  return static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * GaborTable::kScales;
}

}  // namespace

GaborTable::GaborTable(int size, double side)
    : size_(size), side_(side), words_(wordsOf(size, side), 0) {}

void GaborTable::set(int i, int j, int direction, int scale, bool rises) noexcept {
  const std::uint32_t bit = 1u << direction;
  std::uint32_t& bits = words_[word(i, j, scale)];
  bits = rises ? bits | bit : bits & ~bit;
}

int GaborTable::directionOf(double vx, double vy) noexcept {
  const double steps = std::atan2(vy, vx) * (kDirections / kGaborTurn);
  if (std::isnan(steps)) return 0;
  return static_cast<int>(std::floor(steps + 0.5)) & (kDirections - 1);  // -16 is 16
}

/// By doubling instead of a logarithm: exact where a speed is just twice another.
int GaborTable::scaleOf(double speed, double first) noexcept {
  if (!(speed > 0)) return 0;
  int scale = 0;
  while (scale < kScales - 1 && speed >= std::ldexp(first, scale + 1)) ++scale;
  return scale;
}

}  // namespace palpa::haptics
