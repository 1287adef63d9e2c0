#include "apps/record/trial_walk.h"

namespace palpa::record {

void walkTrials(const SessionReader& reader, const std::vector<RecordedTrial>& trials,
                const TrialVisitor& visitor) {
  auto trial = trials.begin();
  const auto begin = [&] {
    if (trial != trials.end()) visitor.begin(*trial);
  };
  const auto finish = [&] {
    visitor.finish(*trial);
    ++trial;
    begin();
  };
  begin();
  reader.ticks([&](const haptics::FlightRecord& record) {
    while (trial != trials.end() &&
           record.commands.trial > static_cast<std::uint32_t>(trial->header.trial))
      finish();
    if (trial != trials.end() && !trial->isOver(record.t_ns)) visitor.tick(record);
  });
  while (trial != trials.end()) finish();
}

}  // namespace palpa::record
