#include "apps/console/blinding.h"

#include <algorithm>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string_view>

#include "anatomy/base/json_text.h"
#include "apps/live/live_sink.h"
#include "apps/runtime/event_kind.h"
#include "apps/training/trial_words.h"

namespace palpa::console {
namespace {

using nlohmann::json;
using runtime::EventKind;

/// As a curve without points: pages pass it over.
json nothing() { return {{"kind", "curve"}}; }

json only(const json& entry, std::initializer_list<const char*> fields) {
  json kept{{"kind", entry.at("kind")}};
  for (const char* field : fields)
    if (entry.contains(field)) kept[field] = entry.at(field);
  return kept;
}

json status(const json& entry) {
  json kept = only(entry, {"state", "trial", "trials", "emergency_stop", "elapsed_s", "t_s"});
  // An alarm may be of what the hand touches, and be shown in one condition only; what the station
  // has to cry out is an event, too.
  kept["alarm"] = false;
  kept["notice"] = "";
  return kept;
}

/// Of those that people and machines cause; what the hand does tells what it was given.
json event(const json& entry) {
  struct Kind {
    EventKind kind;
    const char* words;  ///< in place of its own; null: its own
  };
  constexpr Kind kHeard[] = {
      {EventKind::ready, "Ready"},    {EventKind::start, "The trial began"},
      {EventKind::pause, "Paused"},   {EventKind::resume, "It went on"},
      {EventKind::safety, nullptr},   {EventKind::emergency_stop, nullptr},
      {EventKind::rearm, nullptr},    {EventKind::device, nullptr},
      {EventKind::camera, nullptr},   {EventKind::note, nullptr},
      {EventKind::computer, nullptr},
  };
  const json name = entry.value("event", json());
  for (const Kind& one : kHeard) {
    if (name != runtime::nameOf(one.kind)) continue;
    json kept = only(entry, {"t_s", "about_s", "trial", "event", "text"});
    if (one.words) kept["text"] = one.words;
    kept["tone"] = one.kind == EventKind::note ? "note" : "neutral";
    return kept;
  }
  return nothing();
}

json end(const json& entry) {
  const json outcome = entry.value("outcome", json());
  const bool counts = !outcome.is_string() || !training::isVoid(outcome.get<std::string>());
  return counts ? only(entry, {"t_s", "trial"})
                : only(entry, {"t_s", "trial", "outcome", "reason"});
}

json kept(const json& entry) {
  if (!entry.is_object() || !entry.contains("kind")) return nothing();
  const json& kind = entry.at("kind");
  if (kind == "hello") return only(entry, {"uuid", "trainee", "simulated", "trials"});
  if (kind == "status") return status(entry);
  if (kind == "trial") return only(entry, {"t_s", "trial"});
  if (kind == "trial_end") return end(entry);
  if (kind == "event") return event(entry);
  if (kind == "refused") return entry;
  return nothing();
}

}  // namespace

std::string blinded(const std::string& entry) {
  return live::entryOf(kept(parsedOrDiscarded(entry)));
}

}  // namespace palpa::console
