#include "apps/trial/load_watch.h"

#include <algorithm>
#include <cstdio>

namespace palpa::trial {
namespace {

constexpr double kTooLate = 0.5;      // of a tick's period: beyond, forces stutter
constexpr double kFewFrames = 15;     // a second: half of what a window shows
constexpr double kFarBehind_s = 0.5;  // of evidence that a killed program would lose

std::string withFigure(const char* pattern, double figure) {
  char text[128];
  std::snprintf(text, sizeof text, pattern, figure);
  return text;
}

}  // namespace

LoadWatch::Seen LoadWatch::seenOn(const runtime::Bus& bus, std::uint64_t frames) {
  return {frames,
          bus.haptic_to_recorder.overflows() + bus.geometry_to_recorder.overflows() +
              bus.keyframes_to_recorder.overflows() + bus.task_to_recorder.overflows() +
              bus.haptic_to_task.overflows(),
          bus.haptic_to_recorder.waiting()};
}

/// Two ticks are never due closer together than a period; of two devices one tells of a tick.
void LoadWatch::tick(const haptics::FlightRecord& record) {
  if (record.tool != 0) return;
  const std::int64_t due_ns = record.t_ns - record.late_ns;
  if (begun_ && due_ns > due_ns_) period_ns_ = std::min(period_ns_, due_ns - due_ns_);
  if (!begun_) first_ns_ = record.t_ns;
  begun_ = true;
  due_ns_ = due_ns;
  missed_ += record.late_ns > period_ns_;
  if (rehearsed()) return;
  late_.add(record.late_ns);
  newest_ns_ = record.t_ns;
}

void LoadWatch::look(const Seen& seen) {
  seen_ = seen;
  if (!begun_) return;
  if (!looked_) begin_ = seen;
  looked_ = true;
  if (rehearsed()) return;
  frames_ = seen.frames - begin_.frames;
  most_waiting_ = std::max(most_waiting_, seen.waiting);
}

std::vector<LoadWatch::Verdict> LoadWatch::verdicts() const {
  std::vector<Verdict> all;
  const double late_ns = late_.quantile(0.99),
               behind_s =
                   1e-9 * static_cast<double>(period_ns_) * static_cast<double>(most_waiting_),
               frames_a_second =
                   static_cast<double>(frames_) / (1e-9 * static_cast<double>(kRehearsal_ns));
  if (late_ns > kTooLate * static_cast<double>(period_ns_))
    all.push_back({withFigure("The haptic loop is late (99 %% below %.1f ms)", 1e-6 * late_ns),
                   "close other programs"});
  if (behind_s > kFarBehind_s)
    all.push_back(
        {withFigure("The evidence is %.1f s behind", behind_s), "write to another disk (--out)"});
  if (frames_a_second < kFewFrames)
    all.push_back({withFigure("The picture is slow (%.0f a second)", frames_a_second),
                   "make the window smaller, close other programs"});
  return all;
}

}  // namespace palpa::trial
