#include "apps/sound/loudspeaker.h"

#include <array>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <utility>

#include "anatomy/base/left_behind.h"
#include "apps/os/real_time.h"
#include "apps/runtime/channels.h"
#include "apps/sound/mixer.h"

namespace palpa::sound {

/// Owned by both threads: what is left behind keeps its own.
struct Loudspeaker::Shared {
  explicit Shared(const runtime::Clock& session) : ahead_ns(session.now() - clock.now()) {}
  std::int64_t now() const { return clock.now() + ahead_ns; }  ///< session time
  void say(State now, const std::string& text) {
    const std::lock_guard lock(mutex);
    words = text;
    state.store(now);
  }
  bool goesOn(std::int64_t drained_ns) const { return !ending.load() || now() < drained_ns; }

  runtime::SteadyClock clock;
  const std::int64_t ahead_ns;  ///< of the session's clock before this one
  runtime::EventQueue<CueStart> starts{64};
  std::atomic<bool> audible{true}, ending{false};
  std::atomic<State> state{State::opening};
  std::atomic<int> gaps{0};
  mutable std::mutex mutex;
  std::condition_variable changed;
  std::string words;
  bool over = false;
};

Loudspeaker::Loudspeaker(const runtime::Clock& session, OpenOutput open)
    : shared_(std::make_shared<Shared>(session)) {
  try {
    thread_ = os::startThread([shared = shared_, open = std::move(open)] {
      run(*shared, open);
      const std::lock_guard lock(shared->mutex);
      shared->over = true;
      shared->changed.notify_all();
    });
  } catch (const std::exception& e) {
    shared_->say(State::silent, e.what());
  }
}

Loudspeaker::~Loudspeaker() {
  shared_->ending.store(true);
  if (!thread_.joinable()) return;
  bool over = false;
  {
    std::unique_lock lock(shared_->mutex);
    const auto end = runtime::ServingClock::now() + std::chrono::nanoseconds(kEndPatience_ns);
    over = shared_->changed.wait_until(lock, end, [this] { return shared_->over; });
  }
  if (over) {
    thread_.join();
  } else {
    thread_.detach();
    leaveBehind(shared_);
  }
}

void Loudspeaker::play(const CueStart& start) noexcept { shared_->starts.push(start); }
void Loudspeaker::setAudible(bool audible) noexcept { shared_->audible.store(audible); }
Loudspeaker::State Loudspeaker::state() const noexcept { return shared_->state.load(); }
int Loudspeaker::gaps() const noexcept { return shared_->gaps.load(); }

std::string Loudspeaker::words() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->words;
}

void Loudspeaker::run(Shared& shared, const OpenOutput& open) {
  try {
    const std::unique_ptr<Output> output = open();
    if (shared.ending.load()) return;
    shared.say(State::playing, output->name());
    stream(shared, *output);
  } catch (const std::exception& e) {
    shared.say(State::silent, e.what());
  }
}

/// Until its owner ends; what sounds then falls silent first, and what is queued is played.
void Loudspeaker::stream(Shared& shared, Output& output) {
  constexpr std::int64_t kDrain_ns = kBlocks * 20 * runtime::kMillisecond;
  Mixer mixer;
  StreamClock clock;
  std::array<std::int16_t, kBlock> block{};
  std::int64_t drained_ns = shared.now() + kDrain_ns;
  while (shared.goesOn(drained_ns)) {
    const std::optional<int> queued = output.room();
    if (!queued) {
      runtime::rest(std::chrono::milliseconds(4));
      continue;
    }
    const bool ending = shared.ending.load();
    if (!ending) drained_ns = shared.now() + kDrain_ns;
    clock.look(shared.now(), mixer.position(), *queued);
    if (*queued == 0 && mixer.position() > 0) shared.gaps.fetch_add(1);
    for (CueStart start; shared.starts.pop(&start);)
      mixer.start(start.cue, clock.sampleAt(start.t_ns + kDelay_ns));
    mixer.setAudible(shared.audible.load() && !ending);
    mixer.render(block);
    output.write(block);
  }
}

SpeakerFound askSpeaker(std::int64_t patience_ns, const OpenOutput& open) {
  const runtime::SteadyClock clock;
  const Loudspeaker speaker(clock, open);
  runtime::comesTrue(std::chrono::milliseconds(patience_ns / runtime::kMillisecond),
                     [&speaker] { return speaker.state() != Loudspeaker::State::opening; });
  return {speaker.state(), speaker.words()};
}

}  // namespace palpa::sound
