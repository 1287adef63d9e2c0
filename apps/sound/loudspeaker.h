#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <thread>

#include "apps/runtime/clock.h"
#include "apps/sound/score.h"

namespace palpa::sound {

/// A device that plays a stream of 48 kHz mono. One thread. Any call may hang: so does the server
/// behind it.
class Output {
 public:
  virtual ~Output() = default;
  virtual std::string name() const = 0;  ///< as its system calls it
  /// Samples that were written and are not heard yet, once there is room for a further block;
  /// empty: there is none now. Throws Error: the device is gone.
  virtual std::optional<int> room() = 0;
  virtual void write(std::span<const std::int16_t> block) = 0;
};
/// Throws Error: there is none, and why.
using OpenOutput = std::function<std::unique_ptr<Output>()>;

/// What the system plays on, by OpenAL Soft. Throws Error where there is none.
std::unique_ptr<Output> openUsualOutput();
/// OpenAL Soft and the libraries below it write to standard error what they tried in vain; from now
/// on they do not. Sets environment variables: before there are threads.
void keepSoundLibrariesQuiet();

/// Plays cues, on a thread of its own that alone touches the device. Whoever makes it, tells it a
/// cue or ends it waits for nothing: a server of sound that does not answer costs the sound.
class Loudspeaker {
 public:
  static constexpr int kBlock = 960;  ///< samples, 20 ms
  static constexpr int kBlocks = 4;   ///< at most so many are queued
  /// From a cue's time to its sound, as long as the device's own delay is: more than what is
  /// queued, so that every cue comes in time to be put where it belongs. Sound that comes as much
  /// later than a picture is taken for one event with it (Vroomen and Keetels, Atten. Percept.
  /// Psychophys. 72, 2010: up to some 200 ms).
  static constexpr std::int64_t kDelay_ns = 100 * runtime::kMillisecond;
  /// The end waits so long for a device to be closed; then it is left behind.
  static constexpr std::int64_t kEndPatience_ns = 500 * runtime::kMillisecond;

  enum class State : std::uint8_t { opening, playing, silent };

  /// `session`: the clock of the cues' times, asked for here alone. `open` is called on the thread.
  explicit Loudspeaker(const runtime::Clock& session, OpenOutput open = openUsualOutput);
  ~Loudspeaker();
  Loudspeaker(const Loudspeaker&) = delete;
  Loudspeaker& operator=(const Loudspeaker&) = delete;

  /// One thread. Where the queue is full, which takes a thread that hangs, the cue is lost.
  void play(const CueStart& start) noexcept;
  void setAudible(bool audible) noexcept;  ///< any thread; at first it is
  State state() const noexcept;            ///< any thread
  /// Playing: on what. Silent: why, in a sentence without its full stop. Opening: empty. Any
  /// thread.
  std::string words() const;
  /// How often the stream had a gap, because nothing was written in time. Any thread.
  int gaps() const noexcept;

 private:
  struct Shared;
  static void run(Shared& shared, const OpenOutput& open);
  static void stream(Shared& shared, Output& output);

  std::shared_ptr<Shared> shared_;
  std::thread thread_;
};

/// Whether there is one, asked on a thread of its own that may hang: for `palpa doctor`. `words` as
/// in Loudspeaker; opening: it did not answer within `patience_ns`.
struct SpeakerFound {
  Loudspeaker::State state = Loudspeaker::State::opening;
  std::string words;
};
SpeakerFound askSpeaker(std::int64_t patience_ns, const OpenOutput& open = openUsualOutput);

}  // namespace palpa::sound
