#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "anatomy/query/local_geometry_builder.h"
#include "apps/bench/stroke.h"
#include "apps/console/session_link.h"
#include "apps/live/port.h"
#include "apps/runtime/activity.h"
#include "apps/runtime/clock.h"
#include "apps/runtime/executive.h"

namespace palpa::bench {

/// How late a loop was, however it was made.
struct LoopTimes {
  runtime::TimeHistogram late;
  std::uint64_t missed = 0;  ///< later than one period
  std::string scheduling;
};

/// What the operating system gives: a timer loop that does nothing, asking for the same priority,
/// memory and `cpu` as the executive's real-time thread. Runs on the calling thread, whose priority
/// it changes.
LoopTimes runBareLoop(std::int64_t period_ns, std::int64_t length_ns, int cpu);

/// Who looks on beside a measurement: the session's port, which encodes and sends, the console's
/// end of it, and as many pages as are asked for, each of which takes every picture. Threads of
/// their own at low priority, as in a session with a console.
class Onlookers {
 public:
  explicit Onlookers(int pages);  ///< throws Error where there can be no local socket

  /// On the scene's thread, once a frame.
  bool wantPicture() const { return port_.wantsPicture() && clock_.now() >= next_ns_; }
  void show(scene::Image picture);
  /// All pages together.
  int pictures() const { return pictures_.load(); }

 private:
  void look(const std::stop_token& ending);

  live::LiveLog log_;
  const std::string path_;
  live::Port port_;
  console::SessionLink link_;
  std::atomic<int> pictures_{0};
  const runtime::SteadyClock clock_;  // goes on from segment to segment
  std::int64_t next_ns_ = 0;
  std::vector<std::jthread> pages_;  ///< told to end, and waited for, however few there are
};

class Onlookers;

/// The program's picture drawn beside a measurement: the reference patient in the 1280 x 720 window
/// without a display, 30 Hz, with a new camera picture and a needle that moves in every frame. One
/// thread only, the constructor's.
class SceneLoad final : public runtime::Activity {
 public:
  SceneLoad();  ///< throws Error where nothing can be drawn
  ~SceneLoad() override;
  const char* name() const override { return "scene"; }
  std::int64_t step(std::int64_t now_ns) override;
  /// From now on they are shown the picture; null: nobody.
  void showTo(Onlookers* onlookers) { onlookers_ = onlookers; }
  int frames() const;
  std::string drawnOn() const;  ///< "surfaceless EGL", ...

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  Onlookers* onlookers_ = nullptr;
};

/// Everything that runs beside the loop, the same whichever loop is measured: the hand's device at
/// 1 kHz, geometry queries at 60 Hz on the torso, the records taken off at 10 Hz, the picture at 30
/// Hz where there is one.
struct LoopSurroundings {
  StrokeSettings stroke;
  const anatomy::LocalGeometryBuilder& builder;
  SceneLoad* scene = nullptr;  ///< null: not drawn
  std::int64_t period_ns = 1'000'000;
  int cpu = -1;
};

struct OurTimes {
  LoopTimes times;
  runtime::TimeSpread cost;
  std::uint64_t contacts = 0;  ///< ticks with a contact force: the step did its work
};

/// HapticActivity (probe) on the real executive for `length_ns`.
OurTimes runOurSegment(const LoopSurroundings& around, std::int64_t length_ns);
/// The bare timer loop, with the same beside it.
LoopTimes runBareSegment(const LoopSurroundings& around, std::int64_t length_ns);

}  // namespace palpa::bench
