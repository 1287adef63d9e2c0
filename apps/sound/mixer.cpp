#include "apps/sound/mixer.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace palpa::sound {
namespace {

constexpr float kGainStep = 1.0F / (0.01F * kRate_Hz);
constexpr double kSample_ns = 1e9 / kRate_Hz;

std::int16_t numberOf(float sample) {
  constexpr float kLargest = 32767;
  return static_cast<std::int16_t>(std::lround(std::clamp(sample, -1.0F, 1.0F) * kLargest));
}

}  // namespace

Mixer::Mixer() {
  for (std::size_t i = 0; i < tones_.size(); ++i) tones_[i] = toneOf(voiceOf(static_cast<Cue>(i)));
  sounding_.reserve(kMostVoices);
}

void Mixer::start(Cue cue, std::int64_t sample) {
  if (sounding_.size() == kMostVoices) sounding_.erase(sounding_.begin());
  sounding_.push_back({cue, std::max(sample, position_)});
}

float Mixer::sampleAt(std::int64_t position) const {
  float sum = 0;
  for (const Sounding& one : sounding_) {
    const std::vector<float>& tone = tones_[static_cast<std::size_t>(one.cue)];
    const std::int64_t at = position - one.first;
    if (at >= 0 && at < static_cast<std::int64_t>(tone.size()))
      sum += tone[static_cast<std::size_t>(at)];
  }
  return sum;
}

void Mixer::render(std::span<std::int16_t> block) {
  for (std::int16_t& number : block) {
    gain_ = audible_ ? std::min(gain_ + kGainStep, 1.0F) : std::max(gain_ - kGainStep, 0.0F);
    number = numberOf(gain_ * sampleAt(position_++));
  }
  std::erase_if(sounding_, [this](const Sounding& one) {
    const std::vector<float>& tone = tones_[static_cast<std::size_t>(one.cue)];
    return one.first + static_cast<std::int64_t>(tone.size()) <= position_;
  });
}

void StreamClock::look(std::int64_t now_ns, std::int64_t position, int queued) {
  const auto length_ns = [](double samples) { return std::llround(samples * kSample_ns); };
  const std::int64_t zero_ns =
      now_ns + length_ns(queued) - length_ns(static_cast<double>(position));
  if (settings_ > 0 && std::abs(zero_ns - zero_ns_) <= kSlip_ns) return;
  zero_ns_ = zero_ns;
  ++settings_;
}

std::int64_t StreamClock::sampleAt(std::int64_t t_ns) const {
  return std::llround(static_cast<double>(t_ns - zero_ns_) / kSample_ns);
}

}  // namespace palpa::sound
