#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/runtime/flight_sink.h"
#include "haptics/flight_record.h"

namespace palpa::live {

/// What a session has told so far, entry by entry (JSON objects): whoever comes late, or was away,
/// reads on from where he was. What passes, curves and words on the screen, is kept of the newest
/// two trials; in place of older ones are curves without points. Any thread but the haptic one.
class LiveLog {
 public:
  /// entries: 5 h of what passes; what happens is told beyond it, too
  static constexpr std::size_t kMostPassing = 200'000;

  void add(std::string entry);
  void addPassing(std::string entry, std::uint32_t trial);  ///< left out beyond kMostPassing
  std::size_t size() const;
  /// At most `most` entries from number `from` (0 is the first).
  std::vector<std::string> since(std::size_t from, std::size_t most) const;

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> entries_;
  std::vector<std::size_t> passing_, passing_before_;  ///< of the newest trial, and the last one
  std::uint32_t trial_ = 0;                            ///< the newest
};

/// What the hand feels, N: of a real thing (where a sensor can say) and of what is rendered,
/// together; without a sensor the computed contact.
double feltForce(const haptics::FlightRecord& record);

/// Force and depth of a trial, thinned for a picture: of every 20 ms the tick, of two tools either,
/// with the greatest force.
class ForceCurve {
 public:
  struct Point {
    double t_s = 0;  ///< session time
    double force_N = 0;
    double depth_mm = 0;  ///< of needle inserted; 0 for what has no needle
  };
  void add(const haptics::FlightRecord& record);
  /// The points that are complete since the last call, as an entry: {"kind": "curve", "trial",
  /// "t_s", "force_N", "depth_mm"}; empty: none.
  std::string take();
  const std::vector<Point>& points() const { return points_; }
  std::uint32_t trial() const { return trial_; }  ///< of the newest point

 private:
  std::vector<Point> points_;
  std::int64_t slot_ = -1;
  Point best_;
  std::uint32_t trial_ = 0;
};

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
  void publishNear();

  runtime::FlightSink& evidence_;
  LiveLog& log_;
  NearMiss near_;
  ToneOf tone_;
  ForceCurve curve_;
  std::optional<haptics::FlightRecord> last_;
  std::string near_words_;  ///< the last that was told
};

/// What is told of an event, as an entry: {"kind": "event", ...}. Empty: nothing. Whoever looks on
/// sees the moment of a picture itself; what a trial is about is written for programs, and is the
/// answer.
std::string eventEntry(const runtime::Event& event, const ToneOf& tone);

/// An entry of the log as it is told; what is no UTF-8 is replaced, so that it can be read.
inline std::string entryOf(const nlohmann::json& entry) {
  return entry.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Session time, to the millisecond.
inline double secondsOf(std::int64_t ns) { return static_cast<double>(ns / 1'000'000) * 1e-3; }

}  // namespace palpa::live
