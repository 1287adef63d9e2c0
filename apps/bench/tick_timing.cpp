#include "apps/bench/tick_timing.h"

#include <memory>

#include "apps/bench/metric.h"
#include "apps/runtime/clock.h"
#include "apps/runtime/quantile.h"

namespace palpa::bench {
namespace {

/// Runs the stroke's ticks again, round and round, with its snapshots when they came.
class Again {
 public:
  Again(const StrokeSettings& settings, const StrokeResult& stroke)
      : config_(strokeConfig(settings)),
        stroke_(stroke),
        state_(std::make_unique<haptics::TickState>()) {}

  void step() {
    const haptics::FlightRecord& was = stroke_.records[at_];
    const LocalGeometry* latest = was.snapshot > 0 ? &stroke_.snapshots[was.snapshot - 1] : nullptr;
    haptics::DeviceReading reading = was.reading;
    reading.sequence = ++sequence_;
    sink_ = haptics::tick(config_, *state_, reading, latest, was.commands, was.t_ns);
    if (++at_ == stroke_.records.size()) {
      at_ = 0;
      *state_ = haptics::TickState{};
    }
  }

 private:
  haptics::TickConfig config_;
  const StrokeResult& stroke_;
  std::unique_ptr<haptics::TickState> state_;
  haptics::FlightRecord sink_;
  std::size_t at_ = 0;
  std::uint64_t sequence_ = 0;
};

}  // namespace

TickTiming timeHot(const StrokeSettings& settings, const StrokeResult& stroke, int ticks) {
  constexpr int kBatch = 16;
  Again again(settings, stroke);
  for (int i = 0; i < 2000; ++i) again.step();
  const runtime::SteadyClock clock;
  std::vector<double> each;
  for (int i = 0; i < ticks; i += kBatch) {
    const std::int64_t start = clock.now();
    for (int k = 0; k < kBatch; ++k) again.step();
    each.push_back(1e-3 * double(clock.now() - start) / kBatch);
  }
  return {runtime::quantile(each, 0.5), runtime::quantile(each, 0.99)};
}

TickTiming timePaced(const StrokeSettings& settings, const StrokeResult& stroke, double seconds) {
  Again again(settings, stroke);
  runtime::SteadyClock clock;
  std::vector<double> each;
  std::int64_t due = clock.now();
  for (int i = 0; i < int(seconds * 1000); ++i) {
    clock.sleepUntil(due += 1'000'000);
    const std::int64_t start = clock.now();
    again.step();
    each.push_back(1e-3 * double(clock.now() - start));
  }
  return {runtime::quantile(each, 0.5), runtime::quantile(each, 0.99)};
}

}  // namespace palpa::bench
