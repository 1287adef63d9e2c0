#include "apps/live/live_sink.h"

#include "apps/live/entry.h"

namespace palpa::live {

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
  if (record.tool != 0 || record.commands.trial == 0) return;
  curve_.add(record);
  last_ = record;
}

void LiveSink::event(const runtime::Event& event) {
  evidence_.event(event);
  log_.add(entryOf({{"kind", "event"},
                    {"t_s", secondsOf(event.t_ns)},
                    {"trial", event.trial},
                    {"event", event.kind},
                    {"text", event.text},
                    {"tone", tone_(event)},
                    {"value", event.value}}));
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
  if (std::string entry = curve_.take(); !entry.empty()) log_.addCurve(std::move(entry));
  tellNear();
}

void LiveSink::tellNear() {
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
