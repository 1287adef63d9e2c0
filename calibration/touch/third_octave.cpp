#include "calibration/touch/third_octave.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

namespace palpa::calibration {
namespace {

using Spectrum = std::vector<std::complex<double>>;
constexpr double kFadedShare = 0.05;
constexpr std::size_t kLeastSignal = 100;
constexpr double kLeastRate_Hz = 900;

void sortByReversedBits(Spectrum& x) {
  for (std::size_t i = 1, j = 0; i < x.size(); ++i) {
    std::size_t bit = x.size() / 2;
    for (; j & bit; bit /= 2) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(x[i], x[j]);
  }
}

/// In place, of a power of two (Cooley & Tukey 1965).
void transform(Spectrum& x) {
  sortByReversedBits(x);
  for (std::size_t length = 2; length <= x.size(); length *= 2) {
    for (std::size_t k = 0; k < length / 2; ++k) {
      const std::complex<double> turn = std::polar(
          1.0, -2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(length));
      for (std::size_t i = k; i < x.size(); i += length) {
        const std::complex<double> even = x[i], odd = turn * x[i + length / 2];
        x[i] = even + odd;
        x[i + length / 2] = even - odd;
      }
    }
  }
}

/// Faded, of the mean power of the signal, and padded with zeros.
Spectrum windowed(const std::vector<double>& signal) {
  std::size_t size = 1;
  while (size < signal.size()) size *= 2;
  Spectrum x(size);
  const double faded = kFadedShare * static_cast<double>(signal.size());
  double weights = 0;
  for (std::size_t i = 0; i < signal.size(); ++i) {
    const double in = static_cast<double>(std::min(i, signal.size() - 1 - i)) / faded,
                 weight = in < 1 ? 0.5 * (1 - std::cos(std::numbers::pi * in)) : 1;
    weights += weight * weight;
    x[i] = weight * signal[i];
  }
  for (std::complex<double>& value : x) value /= std::sqrt(weights * static_cast<double>(size));
  return x;
}

}  // namespace

double thirdOctaveCentre(int i) { return 1000 * std::pow(10, (i - 17) / 10.0); }

std::array<double, kThirdOctaves> thirdOctavePowers(const std::vector<double>& signal,
                                                    double rate_Hz) {
  std::array<double, kThirdOctaves> powers{};
  if (signal.size() < kLeastSignal || !(rate_Hz >= kLeastRate_Hz)) return powers;
  Spectrum x = windowed(signal);
  transform(x);
  const double edge = std::pow(10, 0.05), lines = static_cast<double>(x.size()) / rate_Hz;
  for (int i = 0; i < kThirdOctaves; ++i) {
    const double centre = thirdOctaveCentre(i);
    const auto first = static_cast<std::size_t>(std::ceil(centre / edge * lines)),
               end = static_cast<std::size_t>(std::ceil(centre * edge * lines));
    for (std::size_t k = first; k < end; ++k)
      powers[static_cast<std::size_t>(i)] += 2 * std::norm(x[k]);
  }
  return powers;
}

std::array<double, kThirdOctaves> levelDifference(const std::array<double, kThirdOctaves>& a,
                                                  const std::array<double, kThirdOctaves>& b) {
  constexpr double kNothing = 1e-30, kLeast = 1e-300;
  std::array<double, kThirdOctaves> dB{};
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] > kNothing || b[i] > kNothing)
      dB[i] = 10 * std::log10(std::max(a[i], kLeast) / std::max(b[i], kLeast));
  return dB;
}

}  // namespace palpa::calibration
