#include "apps/twin/virtual_camera_noise.h"

#include <cmath>

namespace palpa::twin::picture {

std::uint64_t randomBits(std::uint64_t stream, std::uint64_t counter) {
  const auto mix = [](std::uint64_t z) {
    z += 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  };
  return mix(mix(stream) ^ counter);
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

}  // namespace palpa::twin::picture
