#include "apps/calibrate/felt_samples.h"

#include <cstddef>

namespace palpa::calibrate {
namespace {

double rateAt(const FeltSamples& felt, std::size_t i) {
  return i > 0 ? (felt.samples[i - 1].p_P.z() - felt.samples[i].p_P.z()) / felt.dt : 0;
}

FeltSamples part(const FeltSamples& felt, std::size_t from, std::size_t to) {
  const auto at = [&](std::size_t i) {
    return felt.samples.begin() + static_cast<std::ptrdiff_t>(i);
  };
  return {felt.dt, {at(from), at(to)}};
}

std::size_t threeQuarters(const FeltSamples& felt) { return felt.samples.size() * 3 / 4; }

}  // namespace

std::vector<calibration::PressSample> pressesOf(const FeltSamples& felt) {
  std::vector<calibration::PressSample> presses;
  for (std::size_t i = 0; i < felt.samples.size(); ++i)
    presses.push_back({-felt.samples[i].p_P.z(), rateAt(felt, i), felt.samples[i].f_P.z()});
  return presses;
}

std::vector<calibration::SlideSample> slidesOf(const FeltSamples& felt) {
  std::vector<calibration::SlideSample> slides;
  for (const FeltSample& s : felt.samples)
    slides.push_back({s.p_P, Vec3::UnitZ(), s.f_P.z(), -Vec3(s.f_P.x(), s.f_P.y(), 0)});
  return slides;
}

std::vector<calibration::LumpSample> lumpTouchesOf(const FeltSamples& felt) {
  std::vector<calibration::LumpSample> touches;
  for (std::size_t i = 0; i < felt.samples.size(); ++i) {
    const FeltSample& s = felt.samples[i];
    touches.push_back({s.p_P, Vec3::UnitZ(), s.f_P, -s.p_P.z(), rateAt(felt, i),
                       s.lump_P.value_or(Vec3::Zero())});
  }
  return touches;
}

FeltSamples toFit(const FeltSamples& felt) { return part(felt, 0, threeQuarters(felt)); }
FeltSamples toJudge(const FeltSamples& felt) {
  return part(felt, threeQuarters(felt), felt.samples.size());
}

}  // namespace palpa::calibrate
