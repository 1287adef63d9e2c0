#pragma once

#include <array>
#include <vector>

namespace palpa::calibration {

/// Third octaves from 20 to 400 Hz, by their exact centres 1000 x 10^((i - 17) / 10) Hz and edges
/// 10^(1/20) above and below (IEC 61260-1).
inline constexpr int kThirdOctaves = 14;
double thirdOctaveCentre(int i);

/// Power of an evenly sampled signal in each of them, the signal's unit squared: its periodogram,
/// with a twentieth faded in at its beginning and out at its end (Tukey's window), summed within
/// the edges. Of a random signal of T seconds a band of the width B scatters by 4.3 dB / sqrt(B T)
/// (0.64 dB at 20 Hz in 10 s). Zero for fewer than 100 samples, or a rate below 900 Hz.
std::array<double, kThirdOctaves> thirdOctavePowers(const std::vector<double>& signal,
                                                    double rate_Hz);

/// 10 lg(a / b) of each; 0 where both are nothing.
std::array<double, kThirdOctaves> levelDifference(const std::array<double, kThirdOctaves>& a,
                                                  const std::array<double, kThirdOctaves>& b);

}  // namespace palpa::calibration
