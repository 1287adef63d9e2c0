#include "apps/doctor/tracker_check.h"

#include <algorithm>
#include <cmath>

#include "apps/doctor/words.h"

namespace palpa::doctor {
namespace {

constexpr const char* kTracker = "tracking system";

std::string placeOf(const station::TrackerSetup& setup) {
  return setup.host + ", port " + std::to_string(setup.port);
}

/// Nobody hears these poses but the counts.
TrackerFacts listen(const station::TrackerSetup& setup, double wait_s) {
  const runtime::SteadyClock clock;
  runtime::EventQueue<runtime::TrackedPose> poses(64);
  igt::TrackerClient client({setup.host, setup.port, setup.transform, setup.X_CK, setup.X_RW,
                             setup.ask_tdata_ms, setup.latency_s},
                            clock, poses);
  const auto heard = [&] {
    return client.counts().poses + client.counts().unusable + client.counts().not_rigid;
  };
  std::int64_t begun = clock.now(), end = begun + std::llround(1e9 * wait_s);
  bool waited = true;
  for (std::int64_t now = begun; now < end; now = clock.now()) {
    const std::int64_t next = client.step(now);
    if (next > now) clock.sleepUntil(std::min(next, end));
    for (runtime::TrackedPose pose; poses.pop(&pose);) {
    }
    if (!waited || heard() == 0) continue;
    waited = false;
    begun = now;
    end = now + runtime::kSecond;
  }
  return {client.counts(), 1e-9 * static_cast<double>(clock.now() - begun)};
}

}  // namespace

Finding judgeTracker(const TrackerFacts& facts, const station::TrackerSetup& setup) {
  const igt::TrackerCounts& c = facts.counts;
  if (!facts.trouble.empty()) return troubled(kTracker, State::ill, facts.trouble);
  if (c.connections == 0)
    return {kTracker, State::ill, "does not answer at " + placeOf(setup),
            "Start its server (PLUS: PlusServer), look at the network's cable, at tracker/host and "
            "tracker/port in the station's file, and at the firewall there"};
  if (c.poses + c.unusable + c.not_rigid == 0)
    return {kTracker, State::note,
            "answers at " + placeOf(setup) + ", but sends no " + setup.transform,
            "Put both markers in its sight; let its server send that transform by this very name "
            "(case counts), or correct tracker/transform; where it waits to be asked, set "
            "tracker/ask_tdata_ms"};
  if (c.poses == 0 && c.not_rigid > 0)
    return {kTracker, State::ill,
            setup.transform + " is no pose: it scales, mirrors or is not finite",
            "Let its server send a rigid transform in millimetres"};
  if (c.poses == 0)
    return {kTracker, State::note, "does not see the camera's marker or the table's",
            "Put both markers in its sight"};
  const double rate_Hz = static_cast<double>(c.poses) / facts.seconds;
  const std::string verdict = text("%.0f poses a second", rate_Hz);
  if (rate_Hz * setup.stale_s < 2)
    return {kTracker, State::note,
            verdict + text(", and after %.0f ms without one the camera counts as lost: the overlay "
                           "will come and go",
                           1e3 * setup.stale_s),
            "Let its server send more often, or see what slows the network"};
  return {kTracker, State::well, verdict + " from " + placeOf(setup)};
}

Finding askTracker(const station::TrackerSetup& setup, double wait_s) {
  try {
    return judgeTracker(listen(setup, wait_s), setup);
  } catch (const std::exception& e) {
    return judgeTracker({{}, 0, e.what()}, setup);
  }
}

}  // namespace palpa::doctor
