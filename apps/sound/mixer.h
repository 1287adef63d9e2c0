#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "apps/sound/score.h"
#include "apps/sound/tones.h"

namespace palpa::sound {

/// One stream of samples from cues that start where they are told to, to the sample. All tones are
/// computed once, when it is made.
class Mixer {
 public:
  static constexpr std::size_t kMostVoices = 16;  ///< at once; one more takes the oldest's place

  Mixer();
  /// `sample` of the stream; one that has passed: with the next block.
  void start(Cue cue, std::int64_t sample);
  /// Rises and falls within 10 ms, so that it does not click.
  void setAudible(bool audible) { audible_ = audible; }
  /// The stream's next samples; what would be beyond the largest number is cut to it.
  void render(std::span<std::int16_t> block);
  std::int64_t position() const { return position_; }  ///< of the next block's first sample

 private:
  struct Sounding {
    Cue cue = Cue::beat;
    std::int64_t first = 0;  ///< sample of the stream
  };
  float sampleAt(std::int64_t position) const;

  std::array<std::vector<float>, kCues> tones_;
  std::vector<Sounding> sounding_;
  std::int64_t position_ = 0;
  bool audible_ = true;
  float gain_ = 1;
};

/// Which sample of the stream is heard at which session time. The stream is set against the session
/// once, and again only where they have come apart by more than kSlip_ns (the computer could not
/// keep up, or the sound card's clock runs differently): between two beats not a sample is lost to
/// a thread that was woken late.
class StreamClock {
 public:
  static constexpr std::int64_t kSlip_ns = 60 * runtime::kMillisecond;

  /// The next sample to be written is `position`, `queued` before it are not heard yet.
  void look(std::int64_t now_ns, std::int64_t position, int queued);
  std::int64_t sampleAt(std::int64_t t_ns) const;
  int settings() const { return settings_; }  ///< how often it was set

 private:
  std::int64_t zero_ns_ = 0;  ///< session time of sample 0
  int settings_ = 0;
};

}  // namespace palpa::sound
