#pragma once

#include <string>
#include <vector>

#include "apps/report/needle/session_report.h"
#include "apps/runtime/flight_sink.h"
#include "apps/session/session_frame.h"
#include "apps/station/material_files.h"
#include "apps/station/task_sections.h"

/// What a report says of any session besides its trials.
namespace palpa::session {

[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern,
                                                 ...);  ///< printf's, up to 255 characters

/// A pseudonym, "simulated expert", "recorded hand".
std::string whoPerformed(const SessionOptions& options);
/// Station, device, calibration, time, software: in this order.
std::vector<report::Fact> stationFactsOf(const SessionOptions& options,
                                         const station::Station& station);
/// Where the task stands, as its file says.
std::vector<report::Fact> taxonomyFacts(const station::Taxonomy& taxonomy);
/// By what the surface that is touched is known.
report::Fact surfaceFact(const station::LumpLibrary& library);
/// Lateness, trips with their causes, what drivers and camera had to say, records lost.
std::vector<report::Fact> runNotes(const SessionRun& run);

/// The parts of a task for its report.
template <typename Trials, typename Of>
report::SubtaskSection partsOf(const station::NamedPlan& plan, const Trials& trials, Of of) {
  report::SubtaskSection section;
  for (const station::NamedPart& part : plan.subtasks)
    section.meanings.emplace_back(part.name, part.means);
  for (const auto& trial : trials) {
    const auto [doses, augmented, seconds] = of(trial);
    section.trials.push_back(doses);
    section.augmented += augmented;
    section.seconds += seconds;
  }
  return section;
}

/// What an event means for the learner: "good", "guide", "bad", "neutral"; "note" of somebody's
/// note. What was touched or pierced is told by its words, the rest by its kind.
std::string toneOfEvent(const runtime::Event& event);

}  // namespace palpa::session
