#pragma once

#include <cstdint>
#include <string>

#include "anatomy/geometry/local_geometry.h"
#include "apps/runtime/event_kind.h"
#include "haptics/flight_record.h"
#include "haptics/loop/tick_state.h"

namespace palpa::runtime {

/// Text of the "safety" event that ends one.
inline constexpr const char* kForceIsBack = "Force is back";

/// Something worth telling, with the moment.
struct Event {
  std::int64_t t_ns = 0;  ///< session time
  int trial = 0;          ///< 0: outside a trial
  std::string kind;       ///< as it is recorded: an EventKind's name, or how a trial ended
  std::string text;       ///< clinical words
  double value = 0;
  bool is(EventKind one) const { return kind == nameOf(one); }
  /// The moment that it is about: a note is of when somebody began it, where that is known.
  std::int64_t about_ns() const {
    return is(EventKind::note) && value > 0 ? static_cast<std::int64_t>(value * 1e9) : t_ns;
  }
};

struct TrialHeader {
  int trial = 0;  ///< 1, 2, ...; unique in the session
  std::int64_t t_ns = 0;
  std::uint64_t seed = 0;
  std::string role;  ///< "scored", "assessed", "familiarisation", "demonstration"
  bool force_feedback = true;
  double puncture_force_N = 0;
};

struct TrialEnd {
  int trial = 0;
  std::int64_t t_ns = 0;  ///< session time of the last tick that was judged
  std::string
      outcome;  ///< "success", "aborted", "time", "passes", "mistaken", "void", "not scored"
  std::string reason;
  std::string scores_json;  ///< as the assessment wrote them; empty when void
};

/// Where a session's evidence goes. Called by the recorder activity only (one thread).
class FlightSink {
 public:
  virtual ~FlightSink() = default;
  virtual void beginTrial(const TrialHeader& header) = 0;
  virtual void snapshot(const LocalGeometry& geometry) = 0;
  virtual void tick(const haptics::FlightRecord& record) = 0;
  virtual void keyframe(std::int64_t tick, const haptics::TickState& state) = 0;
  virtual void event(const Event& event) = 0;
  virtual void endTrial(const TrialEnd& end) = 0;
  virtual void commit() = 0;
};

}  // namespace palpa::runtime
