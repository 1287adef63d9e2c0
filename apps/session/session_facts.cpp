#include "apps/session/session_facts.h"

#include <cstdarg>
#include <cstdio>
#include <map>

#include "anatomy/base/counted.h"
#include "apps/report/page/style.h"

namespace palpa::session {
namespace {

/// Every trip with its cause: how often, and when first.
std::vector<report::Fact> safetyFacts(const std::vector<runtime::Event>& events) {
  std::vector<report::Fact> facts;
  std::map<std::string, std::pair<int, const runtime::Event*>> by_text;
  for (const runtime::Event& event : events) {
    auto& [count, first] = by_text[event.text];
    if (++count == 1) first = &event;
  }
  for (const auto& [text, times] : by_text) {
    const auto& [count, first] = times;
    facts.push_back(
        {text, howOften(count),
         format("first %.1f s after the session's start", 1e-9 * static_cast<double>(first->t_ns)) +
             (first->trial > 0 ? format(", in trial %d", first->trial) : "")});
  }
  return facts;
}

}  // namespace

std::string format(const char* pattern, ...) {
  char text[256];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text, sizeof text, pattern, arguments);
  va_end(arguments);
  return text;
}

std::string whoPerformed(const SessionOptions& options) {
  if (options.who == OperatorKind::person) return options.trainee;
  if (options.who == OperatorKind::recorded) return "recorded hand";
  if (options.who == OperatorKind::learner) return options.trainee + ", a simulated learner";
  const std::string who = options.who == OperatorKind::custom
                              ? "simulated operator of " +
                                    std::filesystem::path(options.operator_file).filename().string()
                              : std::string("simulated ") + nameOf(options.who);
  return options.knows_patient ? who + " who has studied this patient" : who;
}

std::vector<report::Fact> stationFactsOf(const SessionOptions& options,
                                         const station::Station& station) {
  std::vector<report::Fact> facts{
      {"Station", station.title, station.id},
      {"Haptic device", station.device.capabilities.name,
       format("%.1f N, stable to %.0f N/m", station.device.capabilities.max_force_N,
              station.device.capabilities.stable_stiffness)},
      {"Calibration", station.calibration_verdict, station.calibration_date},
      {"On the screen", shownIn(options).name, presentation::describe(shownIn(options))},
      {"Time", options.fast ? "virtual (repeats exactly)" : "real", ""},
      {"Software", std::string("palpa ") + PALPA_VERSION, ""}};
  if (!options.study.id.empty())
    facts.push_back({"Study", options.study.id,
                     "block " + options.study.block});  // not the condition: it may be blind
  return facts;
}

report::Fact surfaceFact(const station::LumpLibrary& library) {
  return {"Softness and friction of the sample", library.of_surface, ""};
}

std::vector<report::Fact> taxonomyFacts(const station::Taxonomy& taxonomy) {
  if (taxonomy.visual.empty()) return {};
  return {{"What is seen", taxonomy.visual, ""},
          {"What is felt", taxonomy.haptic, ""},
          {"What it is for", taxonomy.purpose, ""},
          {"What is changed", taxonomy.property, ""}};
}

std::vector<report::Fact> runNotes(const SessionRun& result) {
  std::vector<report::Fact> facts;
  for (const runtime::Lateness& late : result.lateness)
    if (late.name == "haptic")
      facts.push_back({"Lateness of the haptic loop",
                       format("median %.0f us, 99 %% below %.0f us, 99.9 %% below %.0f us; %llu of "
                              "%llu ticks missed; a step costs %.1f us",
                              late.median_us, late.p99_us, late.p999_us,
                              static_cast<unsigned long long>(late.missed_ticks),
                              static_cast<unsigned long long>(late.steps), late.cost.median_us),
                       late.scheduling});
  for (report::Fact& fact : safetyFacts(result.safety_events)) facts.push_back(std::move(fact));
  facts.insert(facts.end(), result.devices.begin(), result.devices.end());
  for (const std::string& remark : result.camera_remarks)
    facts.push_back({"Camera", remark, "the overlay may shift under a calibration"});
  if (result.video && !result.video->trouble.empty())
    facts.push_back({"Video", result.video->trouble,
                     format("%llu pictures were kept",
                            static_cast<unsigned long long>(result.video->pictures))});
  if (result.dropped)
    facts.push_back({"Records lost",
                     format("%llu", static_cast<unsigned long long>(result.dropped)),
                     "the computer could not keep up: the replay is not exact there"});
  return facts;
}

using runtime::EventKind;

namespace {

/// "Touched: lung": lung.
std::string meaning(const runtime::Event& event) {
  if (!event.is(EventKind::touched) && !event.is(EventKind::wall)) return event.kind;
  const std::size_t at = event.text.rfind(": ");
  return at == std::string::npos ? event.kind : event.text.substr(at + 2);
}

}  // namespace

std::string toneOfEvent(const runtime::Event& event) {
  if (event.is(EventKind::note)) return "note";
  if (event.is(EventKind::safety) && event.text == runtime::kForceIsBack) return "neutral";
  switch (report::toneOfMoment(meaning(event))) {
    case report::Tone::good:
      return "good";
    case report::Tone::guide:
      return "guide";
    case report::Tone::bad:
      return "bad";
    case report::Tone::neutral:
      break;
  }
  return "neutral";
}

}  // namespace palpa::session
