#pragma once

#include <vector>

#include "apps/station/json_file.h"

/// Lists in a station's section "twin" of what shall go wrong on the simulated bench, and when:
/// {"kind", "from_s", "to_s", ...}; session time.
namespace palpa::twin {

/// `entryOf(entry, from, to)` makes a fault of each entry of "twin/<field>"; without the field
/// there are none. Throws UsageError for spans that are none.
template <class Fault, class EntryOf>
std::vector<Fault> readFaults(const station::JsonFile& file, const char* field,
                              const EntryOf& entryOf) {
  constexpr double kLongestSession = 86'400;  // s
  const std::string place = std::string("twin/") + field;
  std::vector<Fault> faults;
  if (!file.has(place)) return faults;
  const nlohmann::json& list = file.json().at("twin").at(field);
  if (!list.is_array()) file.refuse(place, "must be a list");
  for (const nlohmann::json& item : list) {
    const station::JsonFile entry(item, file.name() + ", \"" + place + "\"");
    const double from = entry.number("from_s", 0, kLongestSession),
                 to = entry.number("to_s", 0, kLongestSession);
    if (to <= from) entry.refuse("to_s", "must be later than from_s");
    faults.push_back(entryOf(entry, from, to));
  }
  return faults;
}

/// The kind that "kind" names. `names`: {name, kind} each.
template <class Kind, class Names>
Kind faultKind(const station::JsonFile& entry, const Names& names) {
  const std::string said = entry.text("kind");
  std::string known;
  for (const auto& [name, kind] : names) {
    if (said == name) return kind;
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  entry.refuse("kind", "is \"" + said + "\"; known are " + known);
}

}  // namespace palpa::twin
