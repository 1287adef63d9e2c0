#include "apps/live/live_sink.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

namespace palpa::live {
namespace {

const std::string kNoCurve = R"({"kind":"curve"})";

}  // namespace

void LiveLog::add(std::string entry) {
  const std::lock_guard lock(mutex_);
  entries_.push_back(std::move(entry));
}

void LiveLog::addPassing(std::string entry, std::uint32_t trial) {
  const std::lock_guard lock(mutex_);
  if (trial > trial_) {
    for (const std::size_t i : passing_before_) entries_[i] = std::string(kNoCurve);
    passing_before_ = std::exchange(passing_, {});
    trial_ = trial;
  }
  if (entries_.size() >= kMostPassing) return;
  passing_.push_back(entries_.size());
  entries_.push_back(std::move(entry));
}

std::size_t LiveLog::size() const {
  const std::lock_guard lock(mutex_);
  return entries_.size();
}

std::vector<std::string> LiveLog::since(std::size_t from, std::size_t most) const {
  const std::lock_guard lock(mutex_);
  if (from >= entries_.size()) return {};
  const auto first = entries_.begin() + static_cast<std::ptrdiff_t>(from);
  return {first, first + static_cast<std::ptrdiff_t>(std::min(most, entries_.size() - from))};
}

namespace {

constexpr std::int64_t kSlot = 20'000'000;  // ns

double rounded(double value, double step) { return std::round(value / step) * step; }

}  // namespace

double feltForce(const haptics::FlightRecord& record) {
  if (haptics::hasForce(record.sensed.state))
    return (unpack(record.sensed.f_D) + unpack(record.f_command_D)).norm();
  return unpack(record.f_contact_D).norm();
}

void ForceCurve::add(const haptics::FlightRecord& record) {
  const std::int64_t slot = record.t_ns / kSlot;
  const Point point{static_cast<double>(record.t_ns) * 1e-9, feltForce(record), 1e3 * record.depth};
  if (slot != slot_) {
    if (slot_ >= 0) points_.push_back(best_);
    slot_ = slot;
    best_ = point;
  } else if (point.force_N > best_.force_N) {
    best_ = point;
  }
  trial_ = record.commands.trial;
}

std::string ForceCurve::take() {
  if (points_.empty()) return "";
  nlohmann::json t = nlohmann::json::array(), force = t, depth = t;
  for (const Point& point : points_) {
    t.push_back(rounded(point.t_s, 1e-3));
    force.push_back(std::isfinite(point.force_N) ? rounded(point.force_N, 1e-3) : 0);
    depth.push_back(std::isfinite(point.depth_mm) ? rounded(point.depth_mm, 1e-2) : 0);
  }
  points_.clear();
  return nlohmann::json{
      {"kind", "curve"}, {"trial", trial_}, {"t_s", t}, {"force_N", force}, {"depth_mm", depth}}
      .dump();
}

void LiveSink::beginTrial(const runtime::TrialHeader& header) {
  evidence_.beginTrial(header);
  near_words_.clear();
  log_.add(entryOf({{"kind", "trial"},
                    {"t_s", secondsOf(header.t_ns)},
                    {"trial", header.trial},
                    {"role", header.role}}));
}

void LiveSink::tick(const haptics::FlightRecord& record) {
  evidence_.tick(record);
  if (record.commands.trial == 0) return;
  curve_.add(record);
  if (record.tool == 0) last_ = record;
}

std::string eventEntry(const runtime::Event& event, const ToneOf& tone) {
  if (event.is(runtime::EventKind::picture) || event.is(runtime::EventKind::trial_case)) return "";
  return entryOf({{"kind", "event"},
                  {"t_s", secondsOf(event.t_ns)},
                  {"about_s", secondsOf(event.about_ns())},
                  {"trial", event.trial},
                  {"event", event.kind},
                  {"text", event.text},
                  {"tone", tone(event)},
                  {"value", event.value}});
}

void LiveSink::event(const runtime::Event& event) {
  evidence_.event(event);
  if (std::string entry = eventEntry(event, tone_); !entry.empty()) log_.add(std::move(entry));
}

void LiveSink::endTrial(const runtime::TrialEnd& end) {
  evidence_.endTrial(end);
  log_.add(entryOf({{"kind", "trial_end"},
                    {"t_s", secondsOf(end.t_ns)},
                    {"trial", end.trial},
                    {"outcome", end.outcome},
                    {"reason", end.reason}}));
}

void LiveSink::commit() {
  evidence_.commit();
  if (std::string entry = curve_.take(); !entry.empty())
    log_.addPassing(std::move(entry), curve_.trial());
  publishNear();
}

void LiveSink::publishNear() {
  if (!near_ || !last_ || !last_->commands.armed) return;
  const std::string words = near_(*last_);
  if (!words.empty() && words != near_words_)
    log_.add(entryOf({{"kind", "near"},
                      {"t_s", secondsOf(last_->t_ns)},
                      {"trial", last_->commands.trial},
                      {"text", words},
                      {"tone", "bad"}}));
  near_words_ = words;
}

}  // namespace palpa::live
