#include "apps/runtime/executive.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "apps/os/real_time.h"
#include "apps/os/system_time.h"

namespace palpa::runtime {

int TimeHistogram::binOf(std::int64_t t_ns) noexcept {
  const auto t = static_cast<std::uint64_t>(
      std::clamp<std::int64_t>(t_ns, 0, (std::int64_t{1} << kLongest) - 1));
  const int octave = std::max(static_cast<int>(std::bit_width(t)) - kFine, 0);
  return octave * (1 << (kFine - 1)) + static_cast<int>(t >> octave);
}

double TimeHistogram::middleOf(int bin) noexcept {
  constexpr int kHalf = 1 << (kFine - 1);
  if (bin < 2 * kHalf) return bin;
  const int octave = bin / kHalf - 1;
  const auto low = static_cast<std::int64_t>(bin - octave * kHalf) << octave;
  return static_cast<double>(low) + 0.5 * static_cast<double>((std::int64_t{1} << octave) - 1);
}

void TimeHistogram::add(std::int64_t t_ns) noexcept {
  ++bins_[static_cast<std::size_t>(binOf(t_ns))];
  ++count_;
  max_ns_ = std::max(max_ns_, t_ns);
}

void TimeHistogram::add(const TimeHistogram& other) noexcept {
  for (std::size_t i = 0; i < bins_.size(); ++i) bins_[i] += other.bins_[i];
  count_ += other.count_;
  max_ns_ = std::max(max_ns_, other.max_ns_);
}

double TimeHistogram::quantile(double q) const noexcept {
  const auto rank = static_cast<std::uint64_t>(
      std::clamp(std::ceil(q * static_cast<double>(count_)), 1.0,
                 static_cast<double>(std::max<std::uint64_t>(count_, 1))));
  std::uint64_t up_to = 0;
  for (std::size_t i = 0; i < bins_.size(); ++i)
    if ((up_to += bins_[i]) >= rank)
      return std::min(middleOf(static_cast<int>(i)), static_cast<double>(max_ns_));
  return 0;
}

TimeSpread spreadOf(const TimeHistogram& h) noexcept {
  return {1e-3 * h.quantile(0.5), 1e-3 * h.quantile(0.99), 1e-3 * h.quantile(0.999),
          1e-3 * static_cast<double>(h.max_ns())};
}

namespace {

class VirtualClock final : public Clock {
 public:
  std::int64_t now() const noexcept override { return now_ns; }
  std::int64_t now_ns = 0;
};

class VirtualExecutive final : public Executive {
  struct DueActivity {
    std::int64_t due_ns;
    int priority;
    Activity* activity;
  };

 public:
  explicit VirtualExecutive(StepCosts* costs) : costs_(costs) {}
  TimeMode mode() const override { return TimeMode::virtual_time; }
  const Clock& clock() const override { return clock_; }
  void add(Activity& activity, const ThreadPolicy& policy) override {
    entries_.push_back({0, policy.priority, &activity});
  }
  void stop() noexcept override { stopped_ = true; }

  void run() override {
    try {
      costs_ ? measuredSteps() : steps([](const DueActivity& due, std::int64_t now_ns) {
        return due.activity->step(now_ns);
      });
    } catch (...) {
      endAll();
      throw;
    }
    endAll();
  }

 private:
  void endAll() noexcept {
    for (const DueActivity& entry : entries_) entry.activity->end();
  }

  /// A step costs what has passed since the one before it ended.
  void measuredSteps() {
    std::int64_t before_ns = os::threadsProcessorTime_ns();
    steps([&](const DueActivity& due, std::int64_t now_ns) {
      const std::int64_t next_ns = due.activity->step(now_ns);
      const std::int64_t after_ns = os::threadsProcessorTime_ns();
      (*costs_)[due.activity->name()] += after_ns - before_ns;
      before_ns = after_ns;
      return next_ns;
    });
  }

  template <class Step>
  void steps(Step step) {
    stopped_ = false;
    while (!stopped_) {
      // A handful of activities: a scan is simpler than a heap, and the order is plain to see.
      const auto next = std::min_element(
          entries_.begin(), entries_.end(), [](const DueActivity& a, const DueActivity& b) {
            return a.due_ns != b.due_ns ? a.due_ns < b.due_ns : a.priority < b.priority;
          });
      if (next == entries_.end() || next->due_ns == kNever) return;
      clock_.now_ns = std::max(clock_.now_ns, next->due_ns);
      next->due_ns = step(*next, clock_.now_ns);
    }
  }

  StepCosts* const costs_;
  VirtualClock clock_;
  std::vector<DueActivity> entries_;
  bool stopped_ = false;
};

}  // namespace

std::unique_ptr<Executive> makeVirtualExecutive(StepCosts* costs) {
  return std::make_unique<VirtualExecutive>(costs);
}

namespace {

constexpr std::int64_t kIdle = kNever;

class RealExecutive final : public Executive {
 public:
  TimeMode mode() const override { return TimeMode::real; }
  const Clock& clock() const override { return clock_; }
  void add(Activity& activity, const ThreadPolicy& policy) override {
    auto entry = std::make_unique<ActivityThread>();
    entry->activity = &activity;
    entry->policy = policy;
    entries_.push_back(std::move(entry));
  }
  void stop() noexcept override { stopped_.store(true); }
  void whenStuck(const GiveUp& give_up, std::int64_t patience_ns) override {
    give_up_ = give_up;
    patience_ns_ = patience_ns;
  }

  Stuck stuckFor(std::int64_t time_ns) const override {
    Stuck names;
    const std::int64_t now = clock_.now();
    for (const auto& entry : entries_) {
      const std::int64_t since = entry->since.load();
      if (since != kIdle && now - since >= time_ns) names.push_back(entry->activity->name());
    }
    return names;
  }

  void run() override {
    stopped_.store(false);
    for (auto& entry : entries_) entry->over.store(false);
    std::optional<os::MemoryLock> memory;
    if (std::any_of(entries_.begin(), entries_.end(),
                    [](const auto& e) { return e->policy.real_time; }))
      memory.emplace();
    std::vector<std::thread> threads;
    threads.reserve(entries_.size() + 1);
    if (give_up_) begin(threads, [this] { watchTheEnd(); });
    for (auto& entry : entries_)
      if (!entry->policy.on_caller && !begin(threads, [this, &entry] { loop(*entry); }))
        loop(*entry);
    for (auto& entry : entries_)
      if (entry->policy.on_caller) loop(*entry);
    for (auto& thread : threads) thread.join();
    for (auto& entry : entries_)
      if (memory && entry->policy.real_time) entry->scheduling += "; " + memory->words();
    if (failure_) std::rethrow_exception(failure_);
  }

  std::vector<Lateness> lateness() const override {
    std::vector<Lateness> all;
    for (const auto& e : entries_) {
      const TimeSpread late = spreadOf(e->late);
      all.push_back({e->activity->name(), e->late.count(), late.median_us, late.p99_us,
                     late.p999_us, late.max_us, spreadOf(e->cost), e->missed, e->scheduling,
                     e->late});
    }
    return all;
  }

 private:
  struct ActivityThread {
    Activity* activity = nullptr;
    ThreadPolicy policy;
    TimeHistogram late, cost;
    std::uint64_t missed = 0;
    std::string scheduling = "normal priority";
    std::atomic<std::int64_t> since{kIdle};  ///< its step began
    std::atomic<bool> over{false};
  };

  /// False where the system gives no further thread: all that has begun shall end.
  template <class Work>
  bool begin(std::vector<std::thread>& threads, Work work) {
    try {
      threads.push_back(os::startThread(work));
      return true;
    } catch (...) {
      fail();
      return false;
    }
  }

  /// With what was just thrown, unless something was before.
  void fail() {
    const std::lock_guard lock(failure_mutex_);
    if (!failure_) failure_ = std::current_exception();
    stop();
  }

  /// Until all have ended, or what has not is given up.
  void watchTheEnd() {
    constexpr std::int64_t kLook = 5 * kMillisecond;
    const auto allOver = [this] {
      return std::all_of(entries_.begin(), entries_.end(),
                         [](const auto& entry) { return entry->over.load(); });
    };
    while (!stopped_.load() && !allOver()) clock_.sleepUntil(clock_.now() + kLook);
    const std::int64_t end = clock_.now() + patience_ns_;
    while (!allOver() && clock_.now() < end) clock_.sleepUntil(clock_.now() + kLook);
    Stuck stuck;
    for (const auto& entry : entries_)
      if (!entry->over.load()) stuck.push_back(entry->activity->name());
    if (!stuck.empty()) give_up_(stuck, failureInWords());
  }

  std::string failureInWords() {
    const std::lock_guard lock(failure_mutex_);
    try {
      if (failure_) std::rethrow_exception(failure_);
    } catch (const std::exception& e) {
      return e.what();
    } catch (...) {
      return "an unknown failure";
    }
    return "";
  }

  void loop(ActivityThread& entry) {
    try {
      if (entry.policy.real_time && !stopped_.load())
        entry.scheduling = os::becomeRealTime(entry.policy.cpu);
      const std::int64_t period = entry.activity->period_ns();
      std::int64_t due = clock_.now();
      while (!stopped_.load(std::memory_order_relaxed)) {
        clock_.sleepUntil(due);
        const std::int64_t now = clock_.now();
        entry.since.store(now, std::memory_order_relaxed);
        const std::int64_t next = entry.activity->step(now);
        entry.since.store(kIdle, std::memory_order_relaxed);
        entry.cost.add(clock_.now() - now);
        entry.late.add(now - due);
        entry.missed += period > 0 && now - due > period;
        if (next == kNever) break;
        due = next;
      }
    } catch (...) {
      fail();
    }
    entry.activity->end();
    entry.over.store(true);
  }

  SteadyClock clock_;
  std::vector<std::unique_ptr<ActivityThread>> entries_;
  GiveUp give_up_;
  std::int64_t patience_ns_ = 0;
  std::atomic<bool> stopped_{false};
  std::mutex failure_mutex_;
  std::exception_ptr failure_;
};

}  // namespace

std::unique_ptr<Executive> makeRealExecutive() { return std::make_unique<RealExecutive>(); }

}  // namespace palpa::runtime
