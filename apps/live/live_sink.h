#pragma once

#include <functional>
#include <optional>
#include <string>

#include "apps/live/curve.h"
#include "apps/live/live_log.h"
#include "apps/runtime/flight_sink.h"

namespace palpa::live {

/// What came too near, in words ("1.8 mm from the pleura"); empty: nothing. Asked a few times a
/// second, on the recorder's thread.
using NearMiss = std::function<std::string(const haptics::FlightRecord&)>;

/// "good", "guide", "bad", "neutral" or "note": what an event means for the learner.
using ToneOf = std::function<std::string(const runtime::Event& event)>;

/// Tells what goes into the evidence to the log as well. Evidence comes first: what cannot be told
/// changes nothing there. On the recorder's thread.
class LiveSink final : public runtime::FlightSink {
 public:
  LiveSink(runtime::FlightSink& evidence, LiveLog& log, NearMiss near, ToneOf tone)
      : evidence_(evidence), log_(log), near_(std::move(near)), tone_(std::move(tone)) {}

  void beginTrial(const runtime::TrialHeader& header) override;
  void snapshot(const LocalGeometry& geometry) override { evidence_.snapshot(geometry); }
  void tick(const haptics::FlightRecord& record) override;
  void keyframe(std::int64_t tick, const haptics::TickState& state) override {
    evidence_.keyframe(tick, state);
  }
  void event(const runtime::Event& event) override;
  void endTrial(const runtime::TrialEnd& end) override;
  void commit() override;

 private:
  void tellNear();

  runtime::FlightSink& evidence_;
  LiveLog& log_;
  NearMiss near_;
  ToneOf tone_;
  Curve curve_;
  std::optional<haptics::FlightRecord> last_;
  std::string near_words_;  ///< the last that was told
};

}  // namespace palpa::live
