#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <vector>

#include "apps/runtime/clock.h"
#include "apps/sound/loudspeaker.h"

namespace palpa::sound {

/// What a fake device has taken; shared by the test and the loudspeaker's thread.
class Taken {
 public:
  bool wants() const { return written_.load() < wanted_.load(); }
  void write(std::span<const std::int16_t> block) {
    const std::lock_guard lock(mutex_);
    samples_.insert(samples_.end(), block.begin(), block.end());
    written_.fetch_add(1);
  }
  /// Takes so many further blocks; returns what was in them. Nothing within ten seconds: less.
  std::vector<std::int16_t> next(int blocks) {
    const std::size_t from = count();
    wanted_.fetch_add(blocks);
    runtime::comesTrue(std::chrono::seconds(10), [this] { return !wants(); });
    const std::lock_guard lock(mutex_);
    return {samples_.begin() + static_cast<std::ptrdiff_t>(from), samples_.end()};
  }

 private:
  std::size_t count() const {
    const std::lock_guard lock(mutex_);
    return samples_.size();
  }
  std::atomic<int> wanted_{0}, written_{0};
  mutable std::mutex mutex_;
  std::vector<std::int16_t> samples_;
};

/// Takes blocks as the test asks for them, at no pace of its own.
class FakeOutput final : public Output {
 public:
  explicit FakeOutput(std::shared_ptr<Taken> taken) : taken_(std::move(taken)) {}
  std::string name() const override { return "a fake device"; }
  std::optional<int> room() override { return taken_->wants() ? std::optional(1) : std::nullopt; }
  void write(std::span<const std::int16_t> block) override { taken_->write(block); }

 private:
  std::shared_ptr<Taken> taken_;
};

inline OpenOutput openFake(const std::shared_ptr<Taken>& taken) {
  return [taken] { return std::make_unique<FakeOutput>(taken); };
}

/// Of these samples, 0 to 1.
inline double largestIn(const std::vector<std::int16_t>& samples) {
  int largest = 0;
  for (const std::int16_t sample : samples) largest = std::max(largest, std::abs(int{sample}));
  return largest / 32767.;
}

}  // namespace palpa::sound
